#include "lines.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elvis::hunt {

using oracle::Vector;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/** Halvings of the way between two samples: to 1e-8 pixels from a tenth. */
constexpr int most_halvings = 24;
/** And where elements differ, but the values of none are on both sides as yet. */
constexpr int halvings_to_border = 10;
/** Constraints of faces are of the order of one: this is zero. */
constexpr double on_border = 1e-7;
/** To a minimum between three samples, each by a third: to 1e-6 of their distance. */
constexpr int most_thirds = 34;

} // namespace

LineOracle::LineOracle(oracle::SceneOracle& oracle, const FrameRequest& request)
    : m_oracle(oracle), m_request(request), m_surface(request.surfaces.front()),
      m_is_on_faces(std::holds_alternative<BoundaryFaces>(m_surface.geometry) ||
                    std::holds_alternative<ElementFaces>(m_surface.geometry)) {}

double LineOracle::pixel_length(double depth) const {
    const Camera& camera = m_request.camera;
    const double height =
        camera.orthographic ? camera.height : 2 * std::abs(depth) * std::tan(camera.field_of_view * std::numbers::pi / 360);
    return height / m_request.height;
}

void LineOracle::set_border(const oracle::SurfacePoint& point, Sight& sight) const {
    const oracle::Volume& volume = m_oracle.model().volume;
    oracle::Matrix jacobian;
    volume.position(point.element, point.xi, &jacobian);
    const oracle::Matrix to_world = jacobian.transpose().inverse();
    const auto constraints = oracle::face_constraints(volume.shape(point.element));
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const double value = constraints[i].normal.dot(point.xi) - constraints[i].offset;
        const Vector normal = (to_world * constraints[i].normal).normalized();
        const bool lies_in = std::abs(value) < on_border && std::abs(normal.dot(point.normal)) > 1 - 1e-9;
        if (lies_in && m_is_on_faces)
            sight.face = i;
        if (!lies_in)
            sight.border = std::max(sight.border, value);
    }
}

LineOracle::Sight LineOracle::see(double column, double row) {
    const oracle::Line line =
        oracle::line_of(oracle::pixel_ray(m_request.camera, m_request.width, m_request.height, column, row));
    const oracle::PixelAnswer answer = m_oracle.look(line);
    Sight sight;
    sight.column = column;
    sight.row = row;
    sight.is_hit = answer.surface >= 0;
    if (!sight.is_hit)
        return sight;
    sight.element = answer.point.element;
    sight.value = answer.value;
    sight.depth = answer.point.t;
    sight.position = line.at(answer.point.t);
    if (sight.element != oracle::SurfacePoint::no_element)
        set_border(answer.point, sight);
    return sight;
}

std::vector<LineOracle::Sight> LineOracle::sights(const PictureSquare& square, int n) {
    std::vector<Sight> all;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            all.push_back(
                see(square.column + square.half * (2.0 * i / (n - 1) - 1), square.row + square.half * (2.0 * j / (n - 1) - 1)));
    return all;
}

bool LineOracle::straddles(const Sight& a, const Sight& b, double beyond) const {
    const auto [low, high] = std::minmax(a.value, b.value);
    const double margin = std::max(0.0, beyond);
    return std::ranges::any_of(m_surface.contours->values,
                               [&](double value) { return low <= value - margin && high >= value + margin; });
}

double LineOracle::distance(const Sight& sight, LineKind kind) const {
    if (!sight.is_hit || sight.element == oracle::SurfacePoint::no_element)
        return infinity;
    if (kind == LineKind::mesh_line)
        return std::abs(sight.border);
    double least = infinity;
    for (const double value : m_surface.contours->values)
        least = std::min(least, std::abs(sight.value - value));
    return least;
}

bool LineOracle::is_one_place(const Sight& a, const Sight& b) const {
    return (a.position - b.position).norm() < 1e-3 * pixel_length(std::min(a.depth, b.depth));
}

bool LineOracle::meets_contour(const Sight& a, const Sight& b, double beyond, int depth) {
    if (!a.is_hit && !b.is_hit)
        return false;
    const bool is_same = a.is_hit && b.is_hit && a.element == b.element && a.face == b.face;
    if (is_same && !straddles(a, b, beyond))
        return false;
    if (depth == 0)
        return is_same && is_one_place(a, b);
    if (!is_same && depth <= most_halvings - halvings_to_border)
        return false;
    const Sight middle = see(0.5 * (a.column + b.column), 0.5 * (a.row + b.row));
    const double next = is_same ? 0 : beyond;
    return meets_contour(a, middle, next, depth - 1) || meets_contour(middle, b, next, depth - 1);
}

bool LineOracle::meets_border(const Sight& a, const Sight& b, int depth) {
    if (!a.is_hit && !b.is_hit)
        return false;
    if (a.is_hit && b.is_hit && a.element == b.element && a.face == b.face)
        return false;
    if (depth > 0) {
        const Sight middle = see(0.5 * (a.column + b.column), 0.5 * (a.row + b.row));
        return meets_border(a, middle, depth - 1) || meets_border(middle, b, depth - 1);
    }
    if (a.is_hit && b.is_hit && is_one_place(a, b))
        return true;
    // The nearer one ends: at its border, or where it is clipped or turns away.
    const Sight& nearer = a.is_hit && (!b.is_hit || a.depth < b.depth) ? a : b;
    return std::abs(nearer.border) < on_border;
}

bool LineOracle::is_between(const Sight& a, const Sight& b, const LineSearch& search) {
    return search.kind == LineKind::contour ? meets_contour(a, b, search.beyond, most_halvings)
                                            : meets_border(a, b, most_halvings);
}

bool LineOracle::is_between(const std::vector<Sight>& sights, const LineSearch& search, int n) {
    const auto meets = [&](int i, int j) {
        return is_between(sights[static_cast<std::size_t>(i)], sights[static_cast<std::size_t>(j)], search);
    };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            if ((i + 1 < n && meets(j * n + i, j * n + i + 1)) || (j + 1 < n && meets(j * n + i, (j + 1) * n + i)))
                return true;
    return false;
}

bool LineOracle::is_proven(const PictureSquare& square, const LineSearch& search) {
    return is_between(sights(square, search.n), search, search.n);
}

/** Looks around a sample with ever closer samples, and goes on from the one that is nearest to a line. */
bool LineOracle::is_closer(const PictureSquare& square, Sight start, double half, const LineSearch& search) {
    constexpr int n = 5, n_turns = 8;
    for (int turn = 0; turn < n_turns; ++turn, half *= 0.5) {
        const auto inside = [&](double middle, double x) {
            return std::clamp(x, middle - square.half + half, middle + square.half - half);
        };
        const PictureSquare part{inside(square.column, start.column), inside(square.row, start.row), half};
        const std::vector<Sight> around = sights(part, n);
        if (is_between(around, search, n))
            return true;
        start = *std::ranges::min_element(around, {}, [&](const Sight& sight) { return distance(sight, search.kind); });
        const double nearest = distance(start, search.kind);
        if (nearest <= (search.kind == LineKind::contour ? std::max(0.0, -search.beyond) : on_border))
            return true;
        if (nearest == infinity)
            return false;
    }
    return false;
}

/** Between two places, towards the one that is nearest to a line. */
bool LineOracle::comes_near(Sight from, Sight to, const LineSearch& search) {
    for (int turn = 0; turn < most_thirds; ++turn) {
        const auto at = [&](double share) {
            return see(from.column + share * (to.column - from.column), from.row + share * (to.row - from.row));
        };
        const Sight first = at(1.0 / 3), second = at(2.0 / 3);
        if (is_between(from, first, search) || is_between(second, to, search) || is_between(first, second, search))
            return true;
        (distance(first, search.kind) < distance(second, search.kind) ? to : from) =
            distance(first, search.kind) < distance(second, search.kind) ? second : first;
    }
    return distance(from, search.kind) <= on_border;
}

bool LineOracle::enters_at_edge(const PictureSquare& square, const LineSearch& search) {
    const auto count = static_cast<std::size_t>(search.n);
    for (int edge = 0; edge < 4; ++edge) {
        std::vector<Sight> along;
        std::vector<double> distances;
        for (std::size_t i = 0; i < count; ++i) {
            const double across = 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1,
                         side = edge % 2 == 0 ? -1 : 1;
            along.push_back(see(square.column + square.half * (edge < 2 ? across : side),
                                square.row + square.half * (edge < 2 ? side : across)));
            distances.push_back(distance(along.back(), search.kind));
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t before = i > 0 ? i - 1 : i, after = i + 1 < count ? i + 1 : i;
            const bool is_least = distances[i] <= distances[before] && distances[i] <= distances[after];
            if (is_least && distances[i] < infinity && comes_near(along[before], along[after], search))
                return true;
        }
    }
    return false;
}

bool LineOracle::is_found(const PictureSquare& square, const LineSearch& search) {
    std::vector<Sight> all = sights(square, search.n);
    if (is_between(all, search, search.n))
        return true;
    constexpr std::size_t n_starts = 4;
    std::ranges::sort(all, {}, [&](const Sight& sight) { return distance(sight, search.kind); });
    all.resize(std::min(all.size(), n_starts));
    return std::ranges::any_of(all,
                               [&](const Sight& start) {
                                   return distance(start, search.kind) < infinity &&
                                          is_closer(square, start, 2 * square.half / (search.n - 1), search);
                               }) ||
           (search.kind == LineKind::mesh_line && enters_at_edge(square, search));
}

} // namespace elvis::hunt
