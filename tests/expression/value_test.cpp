// Gradients of expressions against differences of their values.
#include "fixture.hpp"

#include <core/expression/expression.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <iostream>
#include <random>

using namespace elvis;
using namespace elvis::test;

namespace {

using Point = std::array<double, 3>;

/** Sixth order. With h = 0.01 its truncation is about 1e-13 of a seventh derivative, its rounding 1e-14 of the value. */
double difference(const auto& function, const Point& at, std::size_t axis) {
    constexpr double h = 0.01;
    constexpr double weights[] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
    double sum = 0;
    for (int k = 1; k <= 3; ++k) {
        Point plus = at, minus = at;
        plus[axis] += k * h;
        minus[axis] -= k * h;
        sum += weights[k - 1] * (function(plus) - function(minus));
    }
    return sum / h;
}

constexpr const char* expressions[] = {
    "p + u[0] - x",
    "p * u[1] * y",
    "p / u[2]",
    "p ^ 3 + p ^ 2",
    "p ^ -2",
    "p ^ 0.7",
    "p ^ 0.5",
    "p ^ (u[0] / 3)",
    "2 ^ p",
    "sqrt(p)",
    "abs(p - 10) + abs(p)",
    "min(p, 2 + 0 * x) + max(p, u[0] - 10)",
    "sin(p)",
    "cos(p * x)",
    "tan(p / 4)",
    "asin(x / 5)",
    "acos(p / 7)",
    "atan(p)",
    "atan2(p, u[0])",
    "atan2(-p, -u[0])",
    "modulus(p, u[0])",
    "argument(p, u[0])",
    "exp(-p)",
    "log(p) + log10(p)",
    "pow(p, u[1])",
    "norm(u)",
    "u",
    "v + p",
    "dot(u, cross(u, grad(p)))",
    "cross(u, u + x * u)[1]",
    "p > 1 ? sin(p) : cos(p)",
    "(p < 1 && p > 0 || p >= 2) * p",
    "d(p, x)",
    "d(sin(u[0]) * x, z)",
    "grad(p)[1]",
    "norm(grad(p) + u)",
    "curl(u)[0]",
    "norm(vorticity(u) + u)",
    "div(u)",
    "div(p * u)",
    "q_criterion(u)",
    "@jacobian",
    "scaled_jacobian",
    "d(@jacobian, x)",
    "norm(grad((1 + x) * 4 * u))",
    "sqrt(u[0]*u[0] + u[1]*u[1] + u[2]*u[2]) / sqrt(1.4 * p / 'heat flux')",
};

} // namespace

TEST_CASE("gradients of expressions agree with differences") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(-0.9, 0.9);
    double worst = 0;
    for (const char* const text : expressions) {
        const Expression expression(text, test_fields());
        const bool needs_third = !expression.gradient();
        if (std::string(text) == "d(@jacobian, x)") {
            // Second derivatives of the Jacobian are third ones of the mapping.
            CHECK(needs_third);
            continue;
        }
        REQUIRE_FALSE(needs_third);
        double error = 0;
        for (int i = 0; i < 20; ++i) {
            const Point xi{unit(random), unit(random), unit(random)};
            CurvedPoint point(xi);
            const ValueAndGradient result = evaluate_gradient(expression, point);
            CHECK(result.value == evaluate(expression, point));
            const auto value = [&](const Point& at) {
                CurvedPoint there(at);
                return evaluate(expression, there);
            };
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double scale = 1 + std::abs(result.value) + std::abs(result.gradient[axis]);
                error = std::max(error, std::abs(result.gradient[axis] - difference(value, xi, axis)) / scale);
            }
        }
        INFO(text << ": " << error);
        CHECK(error < 1e-10);
        worst = std::max(worst, error);
    }
    std::cout << "largest error of a gradient by xi: " << worst << '\n';
}

TEST_CASE("world derivatives follow the curved mapping") {
    // Functions of x alone: their derivatives are known.
    const Point xi{0.3, -0.4, 0.5};
    CurvedPoint point(xi);
    const auto [x, y, z] = point.position();
    const auto value_of = [&](const char* text) { return evaluate(Expression(text, test_fields()), point); };
    CHECK(value_of("d(x * y * sin(z), z)") == Approx(x * y * std::cos(z)));
    CHECK(value_of("laplacian(x^2 * y + exp(z))") == Approx(2 * y + std::exp(z)));
    CHECK(value_of("d(d(x * y^2, y), x)") == Approx(2 * y));
    // Fields through the inverse mapping, by differences of their gradients along xi: J^T H = d(grad)/dxi.
    const std::array<double, 9> k = inverse3(point.jacobian());
    const char* const axes[] = {"x", "y", "z"};
    double worst = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Expression slope(std::string("d(p, ") + axes[i] + ")", test_fields());
        std::array<double, 3> by_xi{};
        for (std::size_t l = 0; l < 3; ++l) {
            by_xi[l] = difference(
                [&](const Point& at) {
                    CurvedPoint there(at);
                    return evaluate(slope, there);
                },
                xi, l);
        }
        for (std::size_t j = 0; j < 3; ++j) {
            const double expected = by_xi[0] * k[j] + by_xi[1] * k[3 + j] + by_xi[2] * k[6 + j];
            const std::string text = std::string("d(d(p, ") + axes[i] + "), " + axes[j] + ")";
            worst = std::max(worst, std::abs(value_of(text.c_str()) - expected));
        }
    }
    std::cout << "largest error of a second derivative: " << worst << '\n';
    CHECK(worst < 1e-11);
}

TEST_CASE("a length has a derivative where it is zero") {
    const Expression sphere = Expression::implicit("norm(grad(x^2 + y^2)) + norm(cross(grad(x), y * grad(z)))");
    const ValueAndGradient at = evaluate_implicit(sphere, {0, 0, 1});
    CHECK(at.value == 0);
    CHECK(at.gradient == std::array<double, 3>{0, 0, 0});
}

TEST_CASE("implicit functions know space and nothing else") {
    const Expression torus = Expression::implicit("(sqrt(x^2 + y^2) - 2)^2 + z^2 - 0.25");
    const ValueAndGradient at = evaluate_implicit(torus, {2.5, 0, 0});
    CHECK(at.value == Approx(0).margin(1e-15));
    CHECK(at.gradient[0] == Approx(1));
    CHECK_THROWS(Expression::implicit("p"));
    CHECK_THROWS(Expression::implicit("element"));
    CHECK_THROWS(Expression::implicit("jacobian"));
}
