#include <core/extract/element_cells.hpp>

#include <core/extract/shape_division.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace elvis {

namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> edge_ends{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/** An edge on which the level has different signs, while the place between is looked for. */
struct Bracket {
    std::uint32_t below = 0, above = 0;
    /** Shares of the way from the corner below. */
    double lower = 0, upper = 1, at = 0.5;
    bool is_found = false;
    SurfacePoint point;

    /** Newton's step, or half of what is left where that leads out. */
    void narrow(const Vector3& way) {
        constexpr double share_rounding = 1e-15;
        const double value = point.level.value;
        (value < 0 ? lower : upper) = at;
        const double slope = dot(point.level.slope, way), next = at - value / slope;
        const bool is_inside = std::isfinite(next) && next > lower && next < upper;
        const double wanted = is_inside ? next : 0.5 * (lower + upper);
        is_found = value == 0 || std::abs(wanted - at) <= share_rounding || upper - lower <= share_rounding;
        at = is_found ? at : wanted;
    }
};

/** Three of the corners and the one that is on the other side, in an even permutation. */
std::array<std::uint32_t, 4> alone_first(const std::array<std::uint32_t, 4>& c, std::size_t alone) {
    switch (alone) {
    case 0:
        return c;
    case 1:
        return {c[1], c[0], c[3], c[2]};
    case 2:
        return {c[2], c[3], c[0], c[1]};
    default:
        return {c[3], c[2], c[1], c[0]};
    }
}

/** An even permutation with the two that are above in front. */
std::array<std::uint32_t, 4> pair_first(const std::array<std::uint32_t, 4>& c, std::size_t first, std::size_t second) {
    std::array<std::size_t, 4> order{first, second, 0, 0};
    std::size_t n = 2;
    for (std::size_t index = 0; index < 4; ++index) {
        if (index != first && index != second) {
            order[n++] = index;
        }
    }
    std::size_t n_inversions = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            n_inversions += order[i] > order[j] ? 1 : 0;
        }
    }
    if (n_inversions % 2 == 1) {
        std::swap(order[2], order[3]);
    }
    return {c[order[0]], c[order[1]], c[order[2]], c[order[3]]};
}

} // namespace

std::array<std::uint32_t, 2> Cell::edge(std::size_t index) const {
    return {corners[edge_ends[index][0]], corners[edge_ends[index][1]]};
}

void ElementCells::evaluate_new(const SurfaceSampler& sampler) {
    const std::size_t first = m_n_evaluated;
    std::vector<Vector3> xi;
    for (std::size_t i = first; i < m_points.size(); ++i) {
        xi.push_back(m_points[i].xi);
    }
    const std::vector<SurfacePoint> found = sampler.at(m_element, xi, {});
    for (std::size_t i = 0; i < found.size(); ++i) {
        CellPoint& point = m_points[first + i];
        point.position = found[i].position;
        point.level = found[i].level;
        point.contour = found[i].contour;
        point.steepness = length(found[i].world(point.level.slope));
    }
    m_n_evaluated = m_points.size();
}

void ElementCells::place_corners(const SurfaceSampler& sampler) {
    const std::vector<Vector3> places = division_points(m_shape);
    Vector3 middle{};
    for (const Vector3& xi : places) {
        m_points.emplace_back().xi = xi;
        middle = plus(middle, scaled(xi, 1.0 / static_cast<double>(places.size())));
    }
    evaluate_new(sampler);
    m_is_inverted = sampler.at(m_element, std::span(&middle, 1), {}).front().determinant() < 0;
}

void ElementCells::make_cells() {
    std::vector<std::uint32_t> ids;
    for (const CellPoint& point : m_points) {
        ids.push_back(point.id);
    }
    const auto add = [&](const std::vector<std::array<std::uint32_t, 4>>& cells, std::uint8_t n_corners, int face) {
        for (const auto& corners : cells) {
            Cell& cell = m_cells.emplace_back();
            cell.corners = corners;
            cell.n_corners = n_corners;
            cell.local_face = static_cast<std::int8_t>(face);
        }
    };
    if (m_faces.empty()) {
        const bool is_flat = m_shape == ELVIS_SHAPE_QUADRILATERAL || m_shape == ELVIS_SHAPE_TRIANGLE;
        add(divide_shape(m_shape, ids), is_flat ? 3 : 4, -1);
    }
    for (const int face : m_faces) {
        add(divide_face(m_shape, face, ids), 3, face);
    }
}

std::uint32_t ElementCells::middle(std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = m_middles.try_emplace(pair_key(a, b), static_cast<std::uint32_t>(m_points.size()));
    if (is_new) {
        const Vector3 xi = scaled(plus(m_points[a].xi, m_points[b].xi), 0.5);
        m_points.emplace_back().xi = xi;
    }
    return place->second;
}

ElementCells::Halved ElementCells::halve_wanted(const SurfaceSampler& sampler,
                                                const std::function<bool(std::uint64_t, std::uint64_t)>& is_longer) {
    const std::size_t n_cells = m_cells.size();
    Halved halved;
    for (std::size_t index = 0; index < n_cells; ++index) {
        if (m_cells[index].state != Cell::State::wanted) {
            continue;
        }
        const Cell cell = m_cells[index];
        std::size_t longest = 0;
        std::uint64_t longest_key = 0;
        for (std::size_t edge = 0; edge < cell.n_edges(); ++edge) {
            const auto [a, b] = cell.edge(edge);
            const std::uint64_t key = pair_key(m_points[a].id, m_points[b].id);
            if (edge == 0 || is_longer(key, longest_key)) {
                longest = edge;
                longest_key = key;
            }
        }
        halved.edges.push_back(longest_key);
        const auto [a, b] = cell.edge(longest);
        const std::uint32_t between = middle(a, b);
        halved.points.push_back(between);
        Cell half = cell;
        half.state = Cell::State::fresh;
        half.depth = static_cast<std::uint8_t>(cell.depth + 1);
        half.is_undecided = false;
        for (const std::uint32_t replaced : {a, b}) {
            Cell child = half;
            std::ranges::replace(child.corners.begin(), child.corners.begin() + child.n_corners, replaced, between);
            m_cells.push_back(child);
        }
        m_cells[index].state = Cell::State::gone;
    }
    evaluate_new(sampler);
    return halved;
}

void ElementCells::sweep() {
    std::erase_if(m_cells, [](const Cell& cell) { return cell.state == Cell::State::gone; });
}

bool ElementCells::has_surface(const Cell& cell) const {
    if (cell.n_corners == 3) {
        return true;
    }
    const bool first = is_above(m_points[cell.corners[0]]);
    return std::ranges::any_of(cell.corners, [&](std::uint32_t corner) { return is_above(m_points[corner]) != first; });
}

void ElementCells::meet_edges(const SurfaceSampler& sampler, std::span<const std::size_t> cells) {
    std::vector<Bracket> brackets;
    for (const std::size_t index : cells) {
        const Cell& cell = m_cells[index];
        for (std::size_t edge = 0; cell.n_corners == 4 && edge < cell.n_edges(); ++edge) {
            const auto [a, b] = cell.edge(edge);
            if (is_above(m_points[a]) == is_above(m_points[b])) {
                continue;
            }
            const std::uint32_t below = is_above(m_points[a]) ? b : a, above = is_above(m_points[a]) ? a : b;
            const bool is_corner = m_points[above].level.value == 0;
            const auto [place, is_new] = m_met.try_emplace(pair_key(a, b), is_corner ? above : 0);
            if (is_new && !is_corner) {
                Bracket bracket{below, above, 0, 1, 0.5, false, {}};
                const double from = m_points[below].level.value, to = m_points[above].level.value;
                bracket.at = std::clamp(from / (from - to), 1e-3, 1 - 1e-3);
                brackets.push_back(bracket);
            }
        }
    }
    constexpr int most_steps = 100;
    std::vector<std::size_t> open(brackets.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
        open[i] = i;
    }
    for (int step = 0; step < most_steps && !open.empty(); ++step) {
        std::vector<Vector3> xi;
        for (const std::size_t i : open) {
            const Vector3 &from = m_points[brackets[i].below].xi, &to = m_points[brackets[i].above].xi;
            xi.push_back(plus(scaled(from, 1 - brackets[i].at), scaled(to, brackets[i].at)));
        }
        const std::vector<SurfacePoint> found = sampler.at(m_element, xi, {});
        for (std::size_t k = 0; k < open.size(); ++k) {
            Bracket& bracket = brackets[open[k]];
            bracket.point = found[k];
            bracket.narrow(minus(m_points[bracket.above].xi, m_points[bracket.below].xi));
        }
        std::erase_if(open, [&](std::size_t i) { return brackets[i].is_found; });
    }
    for (const Bracket& bracket : brackets) {
        m_met[pair_key(bracket.below, bracket.above)] = static_cast<std::uint32_t>(m_points.size());
        CellPoint& point = m_points.emplace_back();
        point.xi = bracket.point.xi;
        point.position = bracket.point.position;
        point.level = bracket.point.level;
        point.contour = bracket.point.contour;
        point.ends = {bracket.below, bracket.above};
    }
    m_n_evaluated = m_points.size();
}

std::uint32_t ElementCells::met(std::uint32_t a, std::uint32_t b) const {
    const auto found = m_met.find(pair_key(a, b));
    assert(found != m_met.end());
    return found->second;
}

std::vector<CellTriangle> ElementCells::triangles(const Cell& cell) const {
    if (cell.n_corners == 3) {
        return {{cell.corners[0], cell.corners[1], cell.corners[2]}};
    }
    std::vector<std::size_t> above, below;
    for (std::size_t i = 0; i < 4; ++i) {
        (is_above(m_points[cell.corners[i]]) ? above : below).push_back(i);
    }
    std::vector<CellTriangle> all;
    if (above.size() == 1) {
        const auto [p, a, b, c] = alone_first(cell.corners, above[0]);
        all.push_back({met(p, a), met(p, c), met(p, b)});
    } else if (below.size() == 1) {
        const auto [n, a, b, c] = alone_first(cell.corners, below[0]);
        all.push_back({met(n, a), met(n, b), met(n, c)});
    } else if (above.size() == 2) {
        const auto [p, q, a, b] = pair_first(cell.corners, above[0], above[1]);
        const std::array<std::uint32_t, 4> around{met(p, a), met(q, a), met(q, b), met(p, b)};
        const auto side = [&](std::size_t i, std::size_t j) {
            return length(minus(m_points[around[i]].position, m_points[around[j]].position));
        };
        if (side(0, 2) <= side(1, 3)) {
            all = {{around[0], around[1], around[2]}, {around[0], around[2], around[3]}};
        } else {
            all = {{around[1], around[2], around[3]}, {around[1], around[3], around[0]}};
        }
    }
    std::erase_if(all, [](const CellTriangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    return all;
}

} // namespace elvis
