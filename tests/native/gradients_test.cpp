// Gradients in xi: against differences inside, outside and at the collapsed vertices.
#include "spaces.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace elvis::native;

namespace {

// Difference of fifth order or higher: central, 8 points, step chosen so that truncation and rounding are below 1e-9.
double difference(const Space& space, std::span<const double> coefficients, const Point& xi, std::size_t direction) {
    constexpr double h = 4e-3;
    constexpr double weights[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double sum = 0;
    for (int k = 1; k <= 4; ++k) {
        Point ahead = xi;
        Point behind = xi;
        ahead[direction] += k * h;
        behind[direction] -= k * h;
        sum += weights[k - 1] * (evaluate(space, coefficients, ahead) - evaluate(space, coefficients, behind));
    }
    return sum / h;
}

} // namespace

TEST_CASE("Gradients agree with differences") {
    Points points(10);
    double largest = 0;
    for (const Space& space : test_spaces()) {
        CAPTURE(text(space));
        const auto coefficients = points.coefficients(space);
        const auto directions = static_cast<std::size_t>(dimension(space.shape));
        std::vector<double> values(n_modes(space)), gradients(3 * n_modes(space));
        for (int i = 0; i < 5; ++i) {
            // Away from the apex of pyramids, whose functions are rational there.
            Point eta = points.eta(space.shape);
            if (space.shape == Shape::pyramid)
                eta[2] = 0.5 * eta[2] - 0.3;
            const Point xi = expand(space.shape, eta);
            Point gradient{};
            const double value = evaluate(space, coefficients, xi, gradient);
            evaluate_modes(space, xi, values, gradients);
            double sum = 0;
            Point gradient_sum{};
            double size = 1;
            for (std::size_t mode = 0; mode < values.size(); ++mode) {
                sum += coefficients[mode] * values[mode];
                for (std::size_t d = 0; d < 3; ++d) {
                    gradient_sum[d] += coefficients[mode] * gradients[3 * mode + d];
                    size = std::max(size, std::abs(gradients[3 * mode + d]));
                }
            }
            REQUIRE(std::abs(value - sum) < 1e-12 * size);
            REQUIRE(std::abs(value - evaluate(space, coefficients, xi)) < 1e-13 * size);
            for (std::size_t d = 0; d < 3; ++d) {
                REQUIRE(std::abs(gradient[d] - gradient_sum[d]) < 1e-12 * size);
                const double expected = d < directions ? difference(space, coefficients, xi, d) : 0.0;
                const double error = std::abs(gradient[d] - expected) / size;
                largest = std::max(largest, error);
                REQUIRE(error < 1e-7);
            }
        }
    }
    WARN("largest difference " << largest << " of the largest mode gradient");
}

TEST_CASE("Polynomial modes have exact gradients at collapsed vertices and edges") {
    Points points(11);
    for (const Space& space : test_spaces()) {
        const bool rational = space.shape == Shape::pyramid && space.basis != Basis::orthogonal;
        if (rational || space.shape == Shape::hexahedron || space.shape == Shape::quadrilateral)
            continue;
        CAPTURE(text(space));
        const auto coefficients = points.coefficients(space);
        const auto directions = static_cast<std::size_t>(dimension(space.shape));
        for (int i = 0; i < n_corners(space.shape); ++i) {
            Point gradient{};
            const Point xi = corner(space.shape, i);
            evaluate(space, coefficients, xi, gradient);
            const double size = 1 + std::abs(gradient[0]) + std::abs(gradient[1]) + std::abs(gradient[2]);
            // The modes are polynomials in all of space: differences may leave the element.
            for (std::size_t d = 0; d < directions; ++d)
                REQUIRE(std::abs(gradient[d] - difference(space, coefficients, xi, d)) < 1e-6 * size);
        }
    }
}

TEST_CASE("At the apex of rational pyramids gradients are limits along the edge eta1 = eta2 = -1") {
    Points points(12);
    for (const std::uint32_t order : {1U, 2U, 4U, 7U}) {
        const Space space{Shape::pyramid, Basis::modified, {order, order, order}};
        CAPTURE(text(space));
        const auto coefficients = points.coefficients(space);
        Point at_apex{};
        const double value = evaluate(space, coefficients, corner(Shape::pyramid, 4), at_apex);
        for (const double distance : {1e-5, 1e-9}) {
            Point near_apex{};
            const double near_value =
                evaluate(space, coefficients, expand(Shape::pyramid, {-1, -1, 1 - 2 * distance}), near_apex);
            CHECK(std::abs(near_value - value) < 1e3 * distance);
            for (std::size_t d = 0; d < 3; ++d)
                CHECK(std::abs(near_apex[d] - at_apex[d]) < 1e4 * distance + 1e-6);
        }
    }
}

TEST_CASE("Tensor pyramids reproduce continuous functions with their gradients at the apex") {
    // 2 + x + 3 y - 4 z: coefficients by interpolation at the corners of the cube in eta, that is of order 1.
    const Space space{Shape::pyramid, Basis::tensor, {1, 1, 1}};
    std::vector<double> coefficients;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-1.0, 1.0})
            for (const double c : {-1.0, 1.0}) {
                const Point xi = expand(Shape::pyramid, {a, b, c});
                coefficients.push_back(2 + xi[0] + 3 * xi[1] - 4 * xi[2]);
            }
    Points points(13);
    std::vector<Point> places{corner(Shape::pyramid, 4), expand(Shape::pyramid, {0.3, -0.2, 1 - 1e-7})};
    for (int i = 0; i < 20; ++i)
        places.push_back(points.xi(Shape::pyramid));
    for (const Point& xi : places) {
        Point gradient{};
        const double value = evaluate(space, coefficients, xi, gradient);
        CHECK(value == Approx(2 + xi[0] + 3 * xi[1] - 4 * xi[2]).margin(1e-13));
        CHECK(gradient[0] == Approx(1).margin(1e-7));
        CHECK(gradient[1] == Approx(3).margin(1e-7));
        CHECK(gradient[2] == Approx(-4).margin(1e-7));
    }
}
