#include <core/base/vector3.hpp>
#include <core/probe/newton.hpp>
#include <core/probe/reference_shape.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace elvis {
namespace {

constexpr int max_steps = 40;
// After a step this short the next one, by quadratic convergence, would be below rounding.
constexpr double converged_step = 1e-10;
// A target this far beyond a face in the linear model of a point on that face is outside even of a strongly curved element;
// nearer ones are tried from several starts.
constexpr double clearly_outside = 1.0;
// Points per direction of the lattice that starts are chosen from, and how many of them are used.
constexpr int lattice_size = 5;
constexpr std::size_t n_starts = 6;

// Predictions this far outside are approached by half steps, where steps are damped.
constexpr double damped_excess = 0.125;

double largest(const Vector3& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

Vector3 midpoint(const Vector3& a, const Vector3& b) {
    return {std::midpoint(a[0], b[0]), std::midpoint(a[1], b[1]), std::midpoint(a[2], b[2])};
}

double dot(const double* row, const Vector3& v) { return row[0] * v[0] + row[1] * v[1] + row[2] * v[2]; }

// Result of one start.
struct Search {
    Inversion::Outcome outcome = Inversion::Outcome::failed;
    Vector3 xi{};
    double excess = 0;
};

// With `is_damped`, steps towards a prediction that is clearly outside go half the way: on strongly curved elements whole ones
// can lead from one side to the other and back.
Search search(elvis_shape shape, const MappingFunction& mapping, const Vector3& target, const Vector3& start, bool is_damped) {
    Search result;
    Vector3 prediction = start;
    Vector3 point = project_into_shape(shape, start);
    int outside_steps = 0;
    for (int step_count = 0; step_count < max_steps; ++step_count) {
        Vector3 position{};
        std::array<double, 9> jacobian{};
        mapping(point, position, jacobian);
        const std::array<double, 9> inverse = invert_matrix(jacobian);
        const Vector3 residual = minus(target, position);
        const Vector3 step{dot(&inverse[0], residual), dot(&inverse[3], residual), dot(&inverse[6], residual)};
        const Vector3 next = plus(point, step);
        if (!std::isfinite(largest(next)))
            return result;

        // Positions carry rounding relative to their size; the inverse Jacobian takes it to xi.
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        double floor = 0;
        for (std::size_t i = 0; i < 3; ++i)
            floor = std::max(floor, 4 * epsilon *
                                        (std::abs(inverse[3 * i] * target[0]) + std::abs(inverse[3 * i + 1] * target[1]) +
                                         std::abs(inverse[3 * i + 2] * target[2])));
        const double change = largest(minus(next, prediction));
        const double excess = reference_excess(shape, next);
        outside_steps = excess > 1e-3 ? outside_steps + 1 : 0;
        const double far = 1e3; // only the direction of such a prediction means anything
        prediction = {std::clamp(next[0], -far, far), std::clamp(next[1], -far, far), std::clamp(next[2], -far, far)};
        const Vector3 inside = project_into_shape(shape, prediction);
        point = is_damped && excess > damped_excess ? midpoint(point, inside) : inside;
        if (change <= std::max(converged_step, floor)) {
            // A prediction outside that stays: the linear model at the boundary is exact there only to second order, which
            // does not matter below the tolerance.
            const bool is_inside = excess <= inside_tolerance + 2 * floor;
            return {is_inside ? Inversion::Outcome::inside : Inversion::Outcome::outside, next, excess};
        }
    }
    // Predictions that never settle but always point out of the shape.
    if (outside_steps >= max_steps / 2) {
        result.outcome = Inversion::Outcome::outside;
        result.excess = reference_excess(shape, prediction);
    }
    return result;
}

// Points of a lattice in the shape, those whose images come closest to the target first.
std::vector<Vector3> nearest_starts(elvis_shape shape, const MappingFunction& mapping, const Vector3& target) {
    std::vector<double> points;
    for (int k = 0; k < lattice_size; ++k)
        for (int j = 0; j < lattice_size; ++j)
            for (int i = 0; i < lattice_size; ++i) {
                const auto at = [](int index) { return -0.9 + 1.8 * index / (lattice_size - 1); };
                const Vector3 xi{at(i), at(j), at(k)};
                if (reference_excess(shape, xi) <= 0)
                    points.insert(points.end(), xi.begin(), xi.end());
            }
    std::vector<double> positions(points.size());
    mapping(points, positions, {});
    std::vector<std::size_t> order(points.size() / 3);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto distance = [&](std::size_t i) {
        return std::hypot(positions[3 * i] - target[0], positions[3 * i + 1] - target[1], positions[3 * i + 2] - target[2]);
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    order.resize(std::min(order.size(), n_starts));
    std::vector<Vector3> starts;
    for (const std::size_t i : order)
        starts.push_back({points[3 * i], points[3 * i + 1], points[3 * i + 2]});
    return starts;
}

} // namespace

std::array<double, 9> invert_matrix(const std::array<double, 9>& m) {
    const std::array<double, 9> cofactors{m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
                                          m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
                                          m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
    const double determinant = m[0] * cofactors[0] + m[1] * cofactors[3] + m[2] * cofactors[6];
    std::array<double, 9> inverse{};
    for (std::size_t i = 0; i < 9; ++i)
        inverse[i] = cofactors[i] / determinant;
    return inverse;
}

void to_world_gradients(const std::array<double, 9>& jacobian, std::span<double> gradients) {
    const std::array<double, 9> inverse = invert_matrix(jacobian);
    for (std::size_t i = 0; i + 2 < gradients.size(); i += 3) {
        const Vector3 g{gradients[i], gradients[i + 1], gradients[i + 2]};
        for (std::size_t j = 0; j < 3; ++j)
            gradients[i + j] = inverse[j] * g[0] + inverse[3 + j] * g[1] + inverse[6 + j] * g[2];
    }
}

Inversion invert_mapping(elvis_shape shape, const MappingFunction& mapping, const Vector3& target) {
    const Search first = search(shape, mapping, target, reference_centroid(shape), false);
    if (first.outcome == Inversion::Outcome::inside ||
        (first.outcome == Inversion::Outcome::outside && first.excess > clearly_outside))
        return {first.outcome, first.xi};
    bool is_outside = first.outcome == Inversion::Outcome::outside;
    for (const Vector3& start : nearest_starts(shape, mapping, target)) {
        const Search next = search(shape, mapping, target, start, true);
        if (next.outcome == Inversion::Outcome::inside)
            return {next.outcome, next.xi};
        is_outside = is_outside || next.outcome == Inversion::Outcome::outside;
    }
    return {is_outside ? Inversion::Outcome::outside : Inversion::Outcome::failed, {}};
}

} // namespace elvis
