#include <core/base/vector3.hpp>
#include <core/probe/newton.hpp>
#include <core/probe/reference_shape.hpp>
#include <core/probe/search_starts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace elvis {
namespace {

constexpr int max_steps = 40;
// After a step this short the next one, by quadratic convergence, would be below rounding.
constexpr double converged_step = 1e-10;
// And after a step this short where it was so much shorter than the one before that the next one would be as short as that.
constexpr double short_step = 1e-7;
constexpr double negligible_step = 1e-17;
// Points per direction of the lattice that starts are chosen from, and how many of them are used.
constexpr int lattice_size = 5;
constexpr std::size_t n_starts = 6;

// Let a search have settled at p, the point of the shape nearest to a prediction q beyond it, with the Jacobian J at p. If a
// point r of the shape were the target's, then q - r = J^-1 (x(r) - x(p)) - (r - p), whose length is K |r - p| with a K that
// tells how far the mapping is from its linear model. But |r - p| <= |q - r|, since the shape is convex: with K < 1, there is
// no such r. Samples of K stay below this.
constexpr double largest_departure = 0.75;

// Predictions this far outside are approached by half steps, where steps are damped.
constexpr double damped_excess = 0.125;
// Damped steps end slowly. After so many predictions outside, one that is so much farther out than it moves will not come in.
constexpr int settled_outside = 4;
constexpr double settled_share = 0.125;

Vector3 midpoint(const Vector3& a, const Vector3& b) {
    return {std::midpoint(a[0], b[0]), std::midpoint(a[1], b[1]), std::midpoint(a[2], b[2])};
}

// One start, on its way.
struct NewtonSearch {
    Inversion::Outcome outcome = Inversion::Outcome::failed;
    Vector3 xi = nowhere;
    double excess = 0;
    // The next point to be evaluated, in the shape, and the prediction that it came from.
    Vector3 point{}, prediction{};
    double last_change = std::numeric_limits<double>::infinity();
    int n_outside = 0;
    bool is_over = false;
    // Where the mapping was evaluated last, and the inverse of its Jacobian there.
    Vector3 last_point{}, last_position{};
    std::array<double, 9> inverse{};
};

NewtonSearch begin_search(elvis_shape shape, const Vector3& start) {
    NewtonSearch search;
    search.prediction = start;
    search.point = project_into_shape(shape, start);
    return search;
}

// One step, with what the mapping is at search.point. With `is_damped`, steps towards a prediction that is clearly outside go
// half the way: on strongly curved elements whole ones can lead from one side to the other and back.
void advance(elvis_shape shape, const Vector3& target, const double* position, const double* jacobian, bool is_damped,
             NewtonSearch& search) {
    std::array<double, 9> matrix{};
    std::copy_n(jacobian, 9, matrix.begin());
    search.inverse = invert_matrix(matrix);
    search.last_point = search.point;
    search.last_position = {position[0], position[1], position[2]};
    const std::array<double, 9>& inverse = search.inverse;
    const Vector3 residual{target[0] - position[0], target[1] - position[1], target[2] - position[2]};
    const Vector3 step{dot(&inverse[0], residual), dot(&inverse[3], residual), dot(&inverse[6], residual)};
    const Vector3 next = plus(search.point, step);
    if (!std::isfinite(largest(next))) {
        search.is_over = true;
        return;
    }

    // Positions carry rounding relative to their size; the inverse Jacobian takes it to xi.
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    double floor = 0;
    for (std::size_t i = 0; i < 3; ++i)
        floor = std::max(floor, 4 * epsilon *
                                    (std::abs(inverse[3 * i] * target[0]) + std::abs(inverse[3 * i + 1] * target[1]) +
                                     std::abs(inverse[3 * i + 2] * target[2])));
    const double change = largest(minus(next, search.prediction));
    const double next_change = change * change * change / (search.last_change * search.last_change);
    search.last_change = change;
    const double excess = reference_excess(shape, next);
    search.n_outside = excess > 1e-3 ? search.n_outside + 1 : 0;
    const double far = 1e3; // only the direction of such a prediction means anything
    search.prediction = {std::clamp(next[0], -far, far), std::clamp(next[1], -far, far), std::clamp(next[2], -far, far)};
    const Vector3 inside = project_into_shape(shape, search.prediction);
    search.point = is_damped && excess > damped_excess ? midpoint(search.point, inside) : inside;
    const bool stays_outside = is_damped && search.n_outside >= settled_outside && change <= settled_share * excess;
    if (stays_outside || change <= std::max(converged_step, floor) ||
        (change <= short_step && next_change <= negligible_step)) {
        // A prediction outside that stays: the linear model at the boundary is exact there only to second order, which
        // does not matter below the tolerance.
        const bool is_inside = excess <= inside_tolerance + 2 * floor;
        search.outcome = is_inside ? Inversion::Outcome::inside : Inversion::Outcome::outside;
        search.xi = next;
        search.excess = excess;
        search.is_over = true;
    }
}

void end_search(elvis_shape shape, NewtonSearch& search) {
    // Predictions that never settle but always point out of the shape.
    if (!search.is_over && search.n_outside >= max_steps / 2) {
        search.outcome = Inversion::Outcome::outside;
        search.excess = reference_excess(shape, search.prediction);
    }
}

NewtonSearch search_from(elvis_shape shape, const MappingFunction& mapping, const Vector3& target, const Vector3& start,
                         bool is_damped) {
    NewtonSearch search = begin_search(shape, start);
    for (int step = 0; step < max_steps && !search.is_over; ++step) {
        Vector3 position{};
        std::array<double, 9> jacobian{};
        mapping(search.point, position, jacobian);
        advance(shape, target, position.data(), jacobian.data(), is_damped, search);
    }
    end_search(shape, search);
    return search;
}

// All targets at once: a step evaluates the mapping at the points of all that are not over.
std::vector<NewtonSearch> search_together(elvis_shape shape, const MappingFunction& mapping, std::span<const Vector3> targets) {
    const SearchStarts starts(shape, mapping, targets.size());
    std::vector<NewtonSearch> searches;
    searches.reserve(targets.size());
    for (const Vector3& target : targets)
        searches.push_back(begin_search(shape, starts.start(target)));
    std::vector<std::size_t> active(targets.size());
    std::iota(active.begin(), active.end(), std::size_t{0});
    std::vector<double> points, positions, jacobians;
    for (int step = 0; step < max_steps && !active.empty(); ++step) {
        points.clear();
        for (const std::size_t i : active)
            points.insert(points.end(), searches[i].point.begin(), searches[i].point.end());
        positions.resize(points.size());
        jacobians.resize(3 * points.size());
        mapping(points, positions, jacobians);
        for (std::size_t k = 0; k < active.size(); ++k)
            advance(shape, targets[active[k]], &positions[3 * k], &jacobians[9 * k], false, searches[active[k]]);
        std::erase_if(active, [&](std::size_t i) { return searches[i].is_over; });
    }
    for (NewtonSearch& search : searches)
        end_search(shape, search);
    return searches;
}

// Points of the shape and where they lie, evaluated when they are first asked for.
class Lattice {
public:
    Lattice(elvis_shape shape, const MappingFunction& mapping) : m_shape(shape), m_mapping(mapping) {}

    // Three numbers a point.
    const std::vector<double>& points() {
        prepare();
        return m_points;
    }
    const std::vector<double>& positions() {
        prepare();
        return m_positions;
    }

private:
    void prepare() {
        if (!m_points.empty())
            return;
        const auto at = [](int index) { return 2.0 * index / (lattice_size - 1) - 1; };
        for (int k = 0; k < lattice_size; ++k)
            for (int j = 0; j < lattice_size; ++j)
                for (int i = 0; i < lattice_size; ++i) {
                    const Vector3 xi{at(i), at(j), at(k)};
                    if (reference_excess(m_shape, xi) <= 0)
                        m_points.insert(m_points.end(), xi.begin(), xi.end());
                }
        m_positions.resize(m_points.size());
        m_mapping(m_points, m_positions, {});
    }

    elvis_shape m_shape;
    const MappingFunction& m_mapping;
    std::vector<double> m_points, m_positions;
};

Vector3 triple(const std::vector<double>& numbers, std::size_t index) {
    return {numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2]};
}

// The search has settled outside, and the mapping is so near to its linear model that no other start can end elsewhere.
bool is_surely_outside(const NewtonSearch& search, Lattice& lattice) {
    if (search.outcome != Inversion::Outcome::outside)
        return false;
    const double *const points = lattice.points().data(), *const positions = lattice.positions().data();
    bool is_near = true;
    for (std::size_t i = 0; i < lattice.points().size(); i += 3) {
        const Vector3 way = minus(Vector3{points[i], points[i + 1], points[i + 2]}, search.last_point);
        const Vector3 change = minus(Vector3{positions[i], positions[i + 1], positions[i + 2]}, search.last_position);
        const Vector3 predicted{dot(&search.inverse[0], change), dot(&search.inverse[3], change),
                                dot(&search.inverse[6], change)};
        const Vector3 departure = minus(predicted, way);
        const double distance2 = dot(&way[0], way);
        is_near &= distance2 <= 1e-12 || dot(&departure[0], departure) < largest_departure * largest_departure * distance2;
    }
    return is_near;
}

// Of the lattice, those whose images come closest to the target first.
std::vector<Vector3> nearest_starts(Lattice& lattice, const Vector3& target) {
    const std::vector<double>&points = lattice.points(), &positions = lattice.positions();
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
        const Vector3 way = minus(triple(positions, i), target);
        order.emplace_back(dot(&way[0], way), i);
    }
    const std::size_t n = std::min(order.size(), n_starts);
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end());
    order.resize(n);
    std::vector<Vector3> starts;
    for (const auto& [distance, i] : order)
        starts.push_back(triple(points, i));
    return starts;
}

// Goes on from other starts where the first one does not decide.
Inversion decided(elvis_shape shape, const MappingFunction& mapping, const Vector3& target, const NewtonSearch& first,
                  Lattice& lattice) {
    if (first.outcome == Inversion::Outcome::inside || is_surely_outside(first, lattice))
        return {first.outcome, first.xi};
    bool is_outside = first.outcome == Inversion::Outcome::outside;
    for (const Vector3& start : nearest_starts(lattice, target)) {
        const NewtonSearch next = search_from(shape, mapping, target, start, true);
        if (next.outcome == Inversion::Outcome::inside)
            return {next.outcome, next.xi};
        is_outside = is_outside || next.outcome == Inversion::Outcome::outside;
    }
    return {is_outside ? Inversion::Outcome::outside : Inversion::Outcome::failed, nowhere};
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
    return invert_mapping(shape, mapping, std::span(&target, 1)).front();
}

std::vector<Inversion> invert_mapping(elvis_shape shape, const MappingFunction& mapping, std::span<const Vector3> targets) {
    const std::vector<NewtonSearch> searches = search_together(shape, mapping, targets);
    Lattice lattice(shape, mapping);
    std::vector<Inversion> inversions;
    inversions.reserve(targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i)
        inversions.push_back(decided(shape, mapping, targets[i], searches[i], lattice));
    return inversions;
}

} // namespace elvis
