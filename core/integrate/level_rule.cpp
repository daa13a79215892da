#include <core/integrate/level_rule.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace elvis {

namespace {

/** Zero counts as positive. */
bool is_positive(double value) { return value >= 0; }

/** Derivatives of the same sign, of which the smallest is this much of the largest, have no zero between the points. */
constexpr double least_share = 0.25;
/** What samples tell of values nearby holds for so many times the distance. */
constexpr double safety = 1.5;
/** Pieces of a line that are looked into for a zero each. */
constexpr std::size_t n_pieces = 8;
/** Share of a box below which pieces count as nothing. */
constexpr double narrow = 1e-13;

} // namespace

LevelRule::LevelRule(LevelFunction& function, const BlockBox& box) : m_function(function), m_box(box) {
    std::vector<Vector3> points;
    for (std::size_t k = 0; k < n_lattice; ++k) {
        for (std::size_t j = 0; j < n_lattice; ++j) {
            for (std::size_t i = 0; i < n_lattice; ++i) {
                points.push_back({box.lower[0] + static_cast<double>(i) * step(0),
                                  box.lower[1] + static_cast<double>(j) * step(1),
                                  box.lower[2] + static_cast<double>(k) * step(2)});
            }
        }
    }
    m_lattice = function.at(points);
    const auto is_far = [&](const LevelSample& sample) { return is_far_from_zero(sample, {true, true, true}); };
    const auto sign_of = [](const LevelSample& sample) { return is_positive(sample.value); };
    m_is_missed = std::ranges::all_of(m_lattice, is_far) &&
                  (std::ranges::all_of(m_lattice, sign_of) || std::ranges::none_of(m_lattice, sign_of));
    if (!m_is_missed) {
        choose_height();
    }
}

const LevelSample& LevelRule::sample(std::size_t i, std::size_t j, std::size_t k) const {
    return m_lattice[(k * n_lattice + j) * n_lattice + i];
}

/** To first order, half way to the next points of the lattice. */
bool LevelRule::is_far_from_zero(const LevelSample& sample, std::array<bool, 3> axes) const {
    double change = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        change += axes[axis] ? 0.5 * step(axis) * std::abs(sample.slope[axis]) : 0;
    }
    return std::abs(sample.value) > safety * change;
}

bool LevelRule::is_monotone(std::size_t axis, std::array<std::size_t, 3> first, std::array<std::size_t, 3> last) const {
    const bool rises = sample(first[0], first[1], first[2]).slope[axis] > 0;
    double least = HUGE_VAL, most = 0;
    for (std::size_t k = first[2]; k <= last[2]; ++k) {
        for (std::size_t j = first[1]; j <= last[1]; ++j) {
            for (std::size_t i = first[0]; i <= last[0]; ++i) {
                const double slope = (rises ? 1 : -1) * sample(i, j, k).slope[axis];
                least = std::min(least, slope);
                most = std::max(most, slope);
            }
        }
    }
    return least > least_share * most;
}

LevelRule::End LevelRule::end_at(bool is_upper) const {
    End end;
    end.height = is_upper ? m_box.upper[m_height] : m_box.lower[m_height];
    std::size_t n_positive = 0, n_far = 0, n_zero = 0, n = 0;
    std::array<bool, 3> axes{true, true, true};
    axes[m_height] = false;
    for (std::size_t b = 0; b < n_lattice; ++b) {
        for (std::size_t a = 0; a < n_lattice; ++a, ++n) {
            std::array<std::size_t, 3> at{};
            at[m_outer] = a;
            at[m_inner] = b;
            at[m_height] = is_upper ? n_lattice - 1 : 0;
            const LevelSample& there = sample(at[0], at[1], at[2]);
            n_positive += is_positive(there.value);
            n_far += is_far_from_zero(there, axes);
            n_zero += there.value == 0;
        }
    }
    end.is_positive = 2 * n_positive > n;
    // The surface may lie in this end of the box: all of it counts as positive.
    end.has_zeros = n_zero < n && (n_far < n || (n_positive != 0 && n_positive != n));
    return end;
}

/** The axis along which the expression rises or falls most evenly. */
void LevelRule::choose_height() {
    const std::array<std::size_t, 3> first{}, last{n_lattice - 1, n_lattice - 1, n_lattice - 1};
    double best = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!is_monotone(axis, first, last)) {
            continue;
        }
        double least = HUGE_VAL;
        for (const LevelSample& sample : m_lattice) {
            least = std::min(least, std::abs(sample.slope[axis]) * step(axis));
        }
        if (least > best) {
            best = least;
            m_height = axis;
        }
    }
    if (best > 0) {
        choose_inner_axis();
    }
    // It rises, or falls, from one end to the other without a zero.
    m_is_missed = m_is_usable && !m_ends[0].has_zeros && !m_ends[1].has_zeros && m_ends[0].is_positive == m_ends[1].is_positive;
}

/** One along which both ends of the box, where they have zeros, are monotone. */
void LevelRule::choose_inner_axis() {
    for (std::size_t turn = 1; turn <= 2 && !m_is_usable; ++turn) {
        m_inner = (m_height + turn) % 3;
        m_outer = 3 - m_height - m_inner;
        m_ends = {end_at(false), end_at(true)};
        m_is_usable = true;
        for (std::size_t end = 0; end < 2; ++end) {
            std::array<std::size_t, 3> first{}, last{n_lattice - 1, n_lattice - 1, n_lattice - 1};
            first[m_height] = last[m_height] = end == 0 ? 0 : n_lattice - 1;
            m_is_usable = m_is_usable && (!m_ends[end].has_zeros || is_monotone(m_inner, first, last));
        }
    }
}

Vector3 LevelRule::point(double outer, double inner, double height) const {
    Vector3 s{};
    s[m_outer] = outer;
    s[m_inner] = inner;
    s[m_height] = height;
    return s;
}

/** Newton's method, and bisection where that leaves the interval; together for all that have not settled. */
std::vector<double> LevelRule::roots(std::size_t axis, const std::vector<Vector3>& from, double lower, double upper) {
    constexpr int most_steps = 60;
    // Of the box's side 1; a step this short was preceded by one of its square root.
    constexpr double settled = 1e-12;
    struct Bracket {
        double lowest = 0, highest = 0, at = 0;
        bool rises = false;
    };
    std::vector<Vector3> points = from;
    for (Vector3& point : points) {
        point[axis] = upper;
    }
    std::vector<Bracket> brackets;
    for (const LevelSample& end : m_function.at(points)) {
        brackets.push_back({lower, upper, 0.5 * (lower + upper), is_positive(end.value)});
    }
    std::vector<std::size_t> active(from.size());
    std::iota(active.begin(), active.end(), std::size_t{0});
    for (int step = 0; step < most_steps && !active.empty(); ++step) {
        points.clear();
        for (const std::size_t i : active) {
            points.push_back(from[i]);
            points.back()[axis] = brackets[i].at;
        }
        const std::vector<LevelSample>& samples = m_function.at(points);
        std::size_t n_active = 0;
        for (std::size_t k = 0; k < active.size(); ++k) {
            Bracket& bracket = brackets[active[k]];
            const double before = bracket.at;
            (is_positive(samples[k].value) == bracket.rises ? bracket.highest : bracket.lowest) = before;
            bracket.at = before - samples[k].value / samples[k].slope[axis];
            if (!(bracket.at >= bracket.lowest && bracket.at <= bracket.highest)) {
                bracket.at = 0.5 * (bracket.lowest + bracket.highest);
            }
            if (std::abs(bracket.at - before) > settled) {
                active[n_active++] = active[k];
            }
        }
        active.resize(n_active);
    }
    std::vector<double> found;
    for (const Bracket& bracket : brackets) {
        found.push_back(bracket.at);
    }
    return found;
}

/** Where, along the outer axis, the ends' zeros enter and leave the base. */
std::vector<double> LevelRule::outer_breaks() {
    const double lower = m_box.lower[m_outer], upper = m_box.upper[m_outer];
    std::vector<double> breaks{lower, upper};
    for (const End& end : m_ends) {
        if (!end.has_zeros) {
            continue;
        }
        for (const double inner : {m_box.lower[m_inner], m_box.upper[m_inner]}) {
            std::vector<double> places;
            std::vector<Vector3> points;
            for (std::size_t i = 0; i <= n_pieces; ++i) {
                places.push_back(lower + (upper - lower) * static_cast<double>(i) / n_pieces);
                points.push_back(point(places.back(), inner, end.height));
            }
            const std::vector<LevelSample> samples = m_function.at(points);
            for (std::size_t i = 0; i < n_pieces; ++i) {
                if (is_positive(samples[i].value) != is_positive(samples[i + 1].value)) {
                    breaks.push_back(roots(m_outer, {points[i]}, places[i], places[i + 1]).front());
                }
            }
        }
    }
    std::ranges::sort(breaks);
    return breaks;
}

/** Gauss points along the outer axis, between its breaks. */
std::vector<LevelRule::OuterNode> LevelRule::outer_nodes(const GaussLine& line) {
    const double least_width = narrow * (m_box.upper[m_outer] - m_box.lower[m_outer]);
    const std::vector<double> breaks = outer_breaks();
    std::vector<OuterNode> nodes;
    for (std::size_t piece = 0; piece + 1 < breaks.size(); ++piece) {
        const double width = breaks[piece + 1] - breaks[piece];
        for (std::size_t i = 0; width > least_width && i < line.points.size(); ++i) {
            nodes.push_back({breaks[piece] + 0.5 * width * (1 + line.points[i]),
                             0.5 * width * line.weights[i],
                             {m_box.lower[m_inner], m_box.upper[m_inner]}});
        }
    }
    return nodes;
}

/** Where, along the inner axis, an end has its zero: it is one at most. */
void LevelRule::add_inner_breaks(const End& end, std::vector<OuterNode>& nodes) {
    const double lower = m_box.lower[m_inner], upper = m_box.upper[m_inner];
    std::vector<Vector3> points;
    for (const OuterNode& node : nodes) {
        points.push_back(point(node.outer, lower, end.height));
        points.push_back(point(node.outer, upper, end.height));
    }
    const std::vector<LevelSample> samples = m_function.at(points);
    std::vector<Vector3> crossed;
    std::vector<std::size_t> of_node;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (is_positive(samples[2 * i].value) != is_positive(samples[2 * i + 1].value)) {
            crossed.push_back(points[2 * i]);
            of_node.push_back(i);
        }
    }
    const std::vector<double> found = roots(m_inner, crossed, lower, upper);
    for (std::size_t i = 0; i < found.size(); ++i) {
        nodes[of_node[i]].inner_breaks.push_back(found[i]);
    }
}

/** Between the inner breaks of each node, those pieces over which the expression has different signs at the ends. */
std::vector<LevelRule::InnerPiece> LevelRule::crossed_pieces(std::vector<OuterNode>& nodes) {
    const double least_width = narrow * (m_box.upper[m_inner] - m_box.lower[m_inner]);
    std::vector<InnerPiece> pieces;
    std::vector<Vector3> middles;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::vector<double>& breaks = nodes[i].inner_breaks;
        std::ranges::sort(breaks);
        for (std::size_t piece = 0; piece + 1 < breaks.size(); ++piece) {
            const double from = breaks[piece], to = breaks[piece + 1];
            if (to - from > least_width) {
                pieces.push_back({i, from, to});
                middles.push_back(point(nodes[i].outer, 0.5 * (from + to), m_ends[0].height));
                middles.push_back(point(nodes[i].outer, 0.5 * (from + to), m_ends[1].height));
            }
        }
    }
    const std::vector<LevelSample> samples = m_function.at(middles);
    std::vector<InnerPiece> crossed;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (is_positive(samples[2 * i].value) != is_positive(samples[2 * i + 1].value)) {
            crossed.push_back(pieces[i]);
        }
    }
    return crossed;
}

/** Gauss points of the part of the base over which the expression has different signs at the ends. */
std::vector<LevelRule::BaseNode> LevelRule::base_nodes(unsigned n) {
    const GaussLine& line = gauss_line(n);
    std::vector<OuterNode> outer = outer_nodes(line);
    for (const End& end : m_ends) {
        if (end.has_zeros) {
            add_inner_breaks(end, outer);
        }
    }
    std::vector<BaseNode> nodes;
    for (const auto& [index, from, to] : crossed_pieces(outer)) {
        for (std::size_t j = 0; j < n; ++j) {
            nodes.push_back({outer[index].outer, from + 0.5 * (to - from) * (1 + line.points[j]),
                             outer[index].weight * 0.5 * (to - from) * line.weights[j]});
        }
    }
    return nodes;
}

void LevelRule::append_points(unsigned n, ReferencePoints& points) {
    const std::vector<BaseNode> nodes = base_nodes(n);
    std::vector<Vector3> on_surface;
    for (const BaseNode& node : nodes) {
        on_surface.push_back(point(node.outer, node.inner, m_box.lower[m_height]));
    }
    const std::vector<double> heights = roots(m_height, on_surface, m_box.lower[m_height], m_box.upper[m_height]);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        on_surface[i][m_height] = heights[i];
    }
    const std::vector<LevelSample>& samples = m_function.at(on_surface);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        // With xi(s), cofactors of dxi/ds take the slope by s to the determinant times the slope by xi.
        const Vector3 vector =
            scaled(samples[i].reference_slope, nodes[i].weight * samples[i].volume / std::abs(samples[i].slope[m_height]));
        points.xi.insert(points.xi.end(), samples[i].xi.begin(), samples[i].xi.end());
        points.vectors.insert(points.vectors.end(), vector.begin(), vector.end());
    }
}

} // namespace elvis
