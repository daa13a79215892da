// Certified ranges.
#include "spaces.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace elvis::native;

namespace {

// Smallest and largest value at a dense grid in collapsed coordinates, ends included.
Range sampled(const Space& space, std::span<const double> coefficients, int n) {
    Range result{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    const int depth = dimension(space.shape) == 3 ? n : 0;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            for (int k = 0; k <= depth; ++k) {
                const Point eta{2.0 * i / n - 1, 2.0 * j / n - 1, depth == 0 ? 0.0 : 2.0 * k / n - 1};
                const double value = evaluate(space, coefficients, expand(space.shape, eta));
                result = {std::min(result.lower, value), std::max(result.upper, value)};
            }
    return result;
}

} // namespace

TEST_CASE("Ranges contain every sample, and are three times too wide at most") {
    Points points(40);
    for (const Space& space : test_spaces()) {
        CAPTURE(text(space));
        RangeBounder bounder(space);
        for (int i = 0; i < 2; ++i) {
            const auto coefficients = points.coefficients(space);
            const Range certified = bounder(coefficients);
            const Range seen = sampled(space, coefficients, 14);
            // What the evaluation itself may round: a hundred roundings of modes up to 20.
            const double slack = 1e-12;
            REQUIRE(certified.lower <= seen.lower + slack);
            REQUIRE(certified.upper >= seen.upper - slack);
            const Range again = range(space, coefficients);
            REQUIRE(again.lower == certified.lower);
            REQUIRE(again.upper == certified.upper);
            // Not merely true but useful: three times too wide at most, but for what the samples miss.
            REQUIRE(certified.upper - certified.lower < 3.5 * (seen.upper - seen.lower) + 1e-12);
        }
    }
}

TEST_CASE("Ranges of order 1 are exactly those of the corners") {
    Points points(41);
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron}) {
        const Space space{shape, Basis::modified, {1, 1, 1}};
        const auto coefficients = points.coefficients(space);
        const Range certified = range(space, coefficients);
        const auto [low, high] = std::minmax_element(coefficients.begin(), coefficients.end());
        CHECK(certified.lower == *low);
        CHECK(certified.upper == *high);
        const Range seen = sampled(space, coefficients, 10);
        CHECK(seen.lower == Approx(*low).margin(1e-15));
        CHECK(seen.upper == Approx(*high).margin(1e-15));
    }
}

TEST_CASE("Ranges are tight where the function is linear or monotone in a higher space") {
    // A linear function in an order-4 modified space: its Bernstein coefficients are its values at equispaced points.
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron}) {
        const Space space{shape, Basis::modified, {4, 4, 4}};
        // Vertex modes have the same (p, q, r) in both spaces: fit them by evaluating at the corners.
        std::vector<double> coefficients(n_modes(space)), values(n_modes(space));
        for (int i = 0; i < n_corners(shape); ++i) {
            const Point xi = corner(shape, i);
            evaluate_modes(space, xi, values);
            for (std::size_t mode = 0; mode < values.size(); ++mode)
                if (values[mode] == 1.0)
                    coefficients[mode] = 1000 + xi[0] - 2 * xi[1] + 3 * xi[2];
        }
        const Range certified = range(space, coefficients);
        const Range seen = sampled(space, coefficients, 6);
        CAPTURE(name(shape), certified.lower, certified.upper);
        CHECK(std::abs(certified.lower - seen.lower) < 1e-10);
        CHECK(std::abs(certified.upper - seen.upper) < 1e-10);
    }
}

TEST_CASE("Coefficients that are not finite give an infinite range") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const std::uint32_t order : {0U, 1U, 3U})
        for (const double bad : {std::nan(""), infinity, -infinity, 1e308}) {
            const Space space{Shape::tetrahedron, Basis::modified, {order, order, order}};
            std::vector<double> coefficients(n_modes(space), -bad);
            coefficients.back() = bad;
            const Range certified = range(space, coefficients);
            if (std::isfinite(bad) && order <= 1) {
                CHECK(certified.upper == bad);
            } else {
                CHECK(certified.lower == -infinity);
                CHECK(certified.upper == infinity);
            }
        }
}

TEST_CASE("The range of zero is zero") {
    const Space space{Shape::pyramid, Basis::modified, {3, 3, 3}};
    const Range certified = range(space, std::vector<double>(n_modes(space)));
    CHECK(certified.lower == 0);
    CHECK(certified.upper == 0);
}

TEST_CASE("Collapsed orders are the true degrees") {
    // Differences of order degree + 1 along a line in eta vanish, those of order degree do not.
    Points points(42);
    for (const Space& space : test_spaces()) {
        if (*std::max_element(space.order.begin(), space.order.end()) > 5)
            continue; // the leading coefficients fall below rounding
        CAPTURE(text(space));
        const auto degrees = collapsed_order(space);
        const auto coefficients = points.coefficients(space);
        for (std::size_t d = 0; d < static_cast<std::size_t>(dimension(space.shape)); ++d) {
            Point eta{0.3, -0.4, 0.2};
            const auto divided = [&](std::uint32_t n) {
                // Newton's divided difference of n + 1 Chebyshev points.
                std::vector<double> z(n + 1), f(n + 1);
                for (std::uint32_t i = 0; i <= n; ++i) {
                    z[i] = std::cos(3.14159265358979 * (i + 0.5) / (n + 1));
                    eta[d] = z[i];
                    f[i] = evaluate(space, coefficients, expand(space.shape, eta));
                }
                for (std::uint32_t k = 1; k <= n; ++k)
                    for (std::uint32_t i = n; i >= k; --i)
                        f[i] = (f[i] - f[i - 1]) / (z[i] - z[i - k]);
                return std::abs(f[n]) / std::pow(2.0, n);
            };
            CHECK(divided(degrees[d] + 1) < 1e-12);
            CHECK(divided(degrees[d]) > 1e-9);
        }
    }
}
