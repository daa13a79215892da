#include <core/extract/bends.hpp>

#include <core/probe/reference_shape.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace elvis {

namespace {

/** Samples may miss the largest: of a polynomial whose degree the lattice fits, by less than this. */
constexpr double sampled_margin = 1.5;
constexpr double local_margin = 2;

double sum_of_magnitudes(const Vector3& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }
double largest_magnitude(const Vector3& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

/** Of the points of a lattice in the shape, numbers; -1 elsewhere. */
struct ShapeLattice {
    std::size_t n = 0;
    double step = 0;
    std::vector<int> numbers;
    std::vector<Vector3> points;

    ShapeLattice(elvis_shape shape, std::size_t n_wanted) : n(n_wanted), step(2.0 / static_cast<double>(n - 1)) {
        const bool is_flat = shape == ELVIS_SHAPE_QUADRILATERAL || shape == ELVIS_SHAPE_TRIANGLE;
        const std::size_t n_layers = is_flat ? 1 : n;
        numbers.assign(n * n * n_layers, -1);
        for (std::size_t index = 0; index < numbers.size(); ++index) {
            const auto at = [&](std::size_t i) { return -1 + step * static_cast<double>(i); };
            const Vector3 xi{at(index % n), at(index / n % n), is_flat ? 0 : at(index / n / n)};
            // At the apex of pyramids slopes may have no limit.
            const bool is_apex = shape == ELVIS_SHAPE_PYRAMID && xi[2] > 1 - 0.5 * step;
            if (reference_excess(shape, xi) <= 1e-12 && !is_apex) {
                numbers[index] = static_cast<int>(points.size());
                points.push_back(xi);
            }
        }
    }
};

double bend_on(const ShapeLattice& lattice, const std::vector<Vector3>& slopes) {
    double sum = 0;
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis, stride *= lattice.n) {
        double largest = 0;
        for (std::size_t index = 0; index + stride < lattice.numbers.size(); ++index) {
            const int from = lattice.numbers[index], to = lattice.numbers[index + stride];
            if (index / stride % lattice.n + 1 < lattice.n && from >= 0 && to >= 0) {
                const Vector3 change = minus(slopes[static_cast<std::size_t>(to)], slopes[static_cast<std::size_t>(from)]);
                largest = std::max(largest, sum_of_magnitudes(change) / lattice.step);
            }
        }
        sum += largest;
    }
    return sampled_margin * sum;
}

} // namespace

std::vector<double> certified_bends(const RuntimeVolume& volume, const Expression& expression, std::uint32_t time_step,
                                    std::span<const std::uint64_t> elements) {
    const std::optional<Expression::PlainField>& plain = expression.plain();
    if (!plain || plain->component < 0 || !volume.has_derivative_bounds() || elements.empty()) {
        return {};
    }
    constexpr std::uint64_t block = 4096;
    const std::size_t n_components = volume.fields()[plain->field].n_components;
    std::vector<double> bends(elements.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<DerivativeBounds> bounds;
    for (std::size_t at = 0; at < elements.size();) {
        const std::uint64_t first = elements[at], count = std::min(block, volume.n_elements() - first);
        bounds.resize(count * n_components);
        const bool is_certified = volume.derivative_bounds(plain->field, time_step, first, count, bounds) == ELVIS_CERTIFIED;
        for (; at < elements.size() && elements[at] - first < count; ++at) {
            const std::size_t entry = (elements[at] - first) * n_components + static_cast<std::size_t>(plain->component);
            bends[at] = is_certified ? bounds[entry].second : bends[at];
        }
    }
    for (const ClassInfo& info : volume.classes()) {
        const auto begin = std::ranges::lower_bound(elements, info.first_element);
        const auto end = std::ranges::lower_bound(elements, info.first_element + info.n_elements);
        if (info.shape == ELVIS_SHAPE_PYRAMID) {
            std::fill(bends.begin() + (begin - elements.begin()), bends.begin() + (end - elements.begin()),
                      std::numeric_limits<double>::quiet_NaN());
        }
    }
    return bends;
}

bool PolynomialBend::can_bound(elvis_shape shape, unsigned degree) {
    constexpr unsigned most_degree = 12;
    const bool is_known = shape == ELVIS_SHAPE_HEXAHEDRON || shape == ELVIS_SHAPE_PRISM || shape == ELVIS_SHAPE_TETRAHEDRON;
    return is_known && degree <= most_degree;
}

PolynomialBend::PolynomialBend(elvis_shape shape, unsigned degree)
    : m_derivatives(shape, std::array<std::uint32_t, 3>{std::max(2u, degree), std::max(2u, degree), std::max(2u, degree)}) {
    const std::span<const double> nodes = m_derivatives.nodes();
    for (std::size_t at = 0; at < nodes.size(); at += 3) {
        m_nodes.push_back({nodes[at], nodes[at + 1], nodes[at + 2]});
    }
}

double PolynomialBend::of(const SurfaceSampler& sampler, std::uint64_t element) const {
    std::vector<double> numbers(m_derivatives.size());
    const std::vector<SurfacePoint> found = sampler.at(element, m_nodes, {});
    for (std::size_t node = 0; node < found.size(); ++node) {
        numbers[node] = found[node].level.value;
    }
    m_derivatives.interpolate<1>(numbers.data());
    m_derivatives.differentiate<1>(numbers.data());
    // The derivatives are 11, 12, 13, 22, 23, 33, of which mixed ones count twice.
    constexpr std::array<double, SecondDerivatives::n_derivatives> times{1, 2, 2, 1, 2, 1};
    double largest = 0;
    for (std::size_t coefficient = 0; coefficient < m_derivatives.n_coefficients(); ++coefficient) {
        double sum = 0;
        for (std::size_t derivative = 0; derivative < times.size(); ++derivative) {
            sum += times[derivative] * std::abs(numbers[m_derivatives.derivative_at(derivative) + coefficient]);
        }
        largest = std::max(largest, sum);
    }
    return largest;
}

Bend sampled_bend(const SurfaceSampler& sampler, std::uint64_t element, elvis_shape shape, unsigned degree) {
    constexpr unsigned least_points = 4, most_points = 10;
    const ShapeLattice lattice(shape, std::clamp(degree + 2, least_points, most_points));
    const std::vector<SurfacePoint> found = sampler.at(element, lattice.points, {});
    std::vector<Vector3> level, contour;
    for (const SurfacePoint& point : found) {
        level.push_back(point.level.slope);
        contour.push_back(point.contour.slope);
    }
    return {bend_on(lattice, level), bend_on(lattice, contour), false};
}

double local_bend(std::span<const Vector3> corners, std::span<const Vector3> slopes) {
    double largest = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            const double distance = largest_magnitude(minus(corners[i], corners[j]));
            largest = std::max(largest, sum_of_magnitudes(minus(slopes[i], slopes[j])) / distance);
        }
    }
    return local_margin * largest;
}

SimplexFunction::SimplexFunction(std::span<const Vector3> corners, std::span<const double> values,
                                 std::span<const Vector3> slopes, double bend)
    : m_corners(corners), m_slopes(slopes), m_bend(bend) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [least, most] = std::ranges::minmax(corners, {}, [&](const Vector3& corner) { return corner[axis]; });
        m_width = std::max(m_width, most[axis] - least[axis]);
    }
    constexpr std::array<double, 5> squares{0, 0, 1.0 / 4, 4.0 / 9, 9.0 / 16};
    const double off = 0.5 * squares[corners.size()] * m_bend * m_width * m_width;
    for (const double value : values) {
        m_largest = std::max(m_largest, std::abs(value) + off);
    }
    m_is_nowhere_zero = std::ranges::all_of(values, [&](double value) { return value > off; }) ||
                        std::ranges::all_of(values, [&](double value) { return value < -off; });
}

Vector3 SimplexFunction::mean_slope() const {
    Vector3 sum{};
    for (const Vector3& slope : m_slopes) {
        sum = plus(sum, slope);
    }
    return sum;
}

bool SimplexFunction::is_monotone_in_plane(const Vector3& normal) const {
    const Vector3 slope = mean_slope();
    return grows_along(minus(slope, scaled(normal, dot(slope, normal))));
}

bool SimplexFunction::is_monotone_along(const Vector3& direction) const {
    return grows_along(direction) || grows_along(scaled(direction, -1));
}

bool SimplexFunction::grows_along(const Vector3& direction) const {
    constexpr std::array<double, 5> distances{0, 0, 1.0 / 2, 2.0 / 3, 3.0 / 4};
    const double off = distances[m_corners.size()] * m_bend * m_width * largest_magnitude(direction);
    return std::ranges::all_of(m_slopes, [&](const Vector3& slope) { return dot(slope, direction) > off; });
}

} // namespace elvis
