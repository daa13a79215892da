#include <core/extract/nearest.hpp>

#include <core/probe/reference_shape.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Newton's method doubles the digits; the nearest place gains some with each step, since it is near. */
constexpr int newton_steps = 6;
/** Steps leave an element by a bit, where its functions go on smoothly; no farther. */
constexpr double most_step = 0.5;

bool is_flat(elvis_shape shape) { return shape == ELVIS_SHAPE_QUADRILATERAL || shape == ELVIS_SHAPE_TRIANGLE; }

Vector3 shortened(const Vector3& step) {
    const double size = std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
    if (!std::isfinite(size)) {
        return {};
    }
    return size > most_step ? scaled(step, most_step / size) : step;
}

/** The shortest step s with rows . s = values, for one to three rows that are not parallel; zero where they are. */
Vector3 shortest_step(std::span<const Vector3> rows, std::span<const double> values) {
    // Gram-Schmidt: each new direction adds what the step so far lacks.
    Vector3 step{};
    std::vector<Vector3> directions;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        Vector3 direction = rows[row];
        for (const Vector3& before : directions) {
            direction = minus(direction, scaled(before, dot(direction, before)));
        }
        const double size = length(direction);
        if (!(size > 1e-12 * length(rows[row]))) {
            continue;
        }
        direction = scaled(direction, 1 / size);
        step = plus(step, scaled(direction, (values[row] - dot(rows[row], step)) / dot(rows[row], direction)));
        directions.push_back(direction);
    }
    return step;
}

} // namespace

double distance_to_segment(const Vector3& point, const Vector3& from, const Vector3& to) {
    const Vector3 along = minus(to, from), way = minus(point, from);
    const double squared = dot(along, along);
    const double share = squared > 0 ? std::clamp(dot(way, along) / squared, 0.0, 1.0) : 0;
    return length(minus(way, scaled(along, share)));
}

double distance_to_plane(const Vector3& point, const Triangle3& t) {
    const Vector3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double size = length(normal);
    return size > 0 ? std::abs(dot(minus(point, t[0]), normal)) / size : distance_to_triangle(point, t);
}

double distance_to_triangle(const Vector3& point, const Triangle3& t) {
    const Vector3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double squared = dot(normal, normal);
    bool is_over = squared > 0;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3 &from = t[i], &to = t[(i + 1) % 3];
        is_over = is_over && dot(cross(minus(to, from), minus(point, from)), normal) >= 0;
        least = std::min(least, distance_to_segment(point, from, to));
    }
    return is_over ? std::abs(dot(minus(point, t[0]), normal)) / std::sqrt(squared) : least;
}

Vector3 predicted_surface(const SurfacePoint& point) {
    const Vector3 gradient = point.world(point.level.slope);
    const double squared = dot(gradient, gradient);
    return squared > 0 ? minus(point.position, scaled(gradient, point.level.value / squared)) : point.position;
}

std::vector<SurfacePoint> nearest_on_surface(const SurfaceSampler& sampler, const SurfaceElement& element,
                                             std::span<const NearestQuery> queries) {
    std::vector<Vector3> xi;
    for (const NearestQuery& query : queries) {
        xi.push_back(query.xi);
    }
    std::vector<SurfacePoint> found;
    for (int step = 0; step < newton_steps; ++step) {
        found = sampler.at(element.element, xi, element.face_normal);
        for (std::size_t i = 0; i < queries.size() && step + 1 < newton_steps; ++i) {
            const SurfacePoint& here = found[i];
            const Vector3 gradient = here.world(here.level.slope), way = minus(queries[i].target, here.position);
            const double squared = dot(gradient, gradient);
            const double off = squared > 0 ? (dot(way, gradient) + here.level.value) / squared : 0;
            xi[i] = plus(xi[i], shortened(here.reference(minus(way, scaled(gradient, off)))));
            const bool is_inside_kept = sampler.has_level() && !is_flat(element.shape);
            xi[i] = is_inside_kept ? project_into_shape(element.shape, xi[i]) : xi[i];
        }
    }
    return found;
}

std::vector<SurfacePoint> points_of_curves(const SurfaceSampler& sampler, const SurfaceElement& element,
                                           std::span<const CurveQuery> queries) {
    std::vector<Vector3> xi;
    for (const CurveQuery& query : queries) {
        xi.push_back(query.xi);
    }
    std::vector<SurfacePoint> found;
    for (int step = 0; step < newton_steps; ++step) {
        found = sampler.at(element.element, xi, element.face_normal);
        for (std::size_t i = 0; i < queries.size() && step + 1 < newton_steps; ++i) {
            const SurfacePoint& here = found[i];
            std::vector<Vector3> rows;
            std::vector<double> values;
            if (queries[i].face) {
                rows.push_back(here.world(*queries[i].face));
                values.push_back(0);
            }
            rows.push_back(here.world(here.level.slope));
            values.push_back(-here.level.value);
            if (queries[i].contour) {
                rows.push_back(here.world(here.contour.slope));
                values.push_back(*queries[i].contour - here.contour.value);
            }
            xi[i] = plus(xi[i], shortened(here.reference(shortest_step(rows, values))));
        }
    }
    return found;
}

} // namespace elvis
