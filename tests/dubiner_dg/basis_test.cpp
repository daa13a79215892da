/*
 * Dubiner's modes against their definition in collapsed coordinates, and bounds of their sums against samples.
 */
#include <plugins/dubiner_dg/basis.hpp>
#include <plugins/dubiner_dg/bernstein.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

using namespace elvis::dubiner;

namespace {

/** P_n^(alpha, 0)(x) by its explicit sum. */
double jacobi(std::size_t n, std::size_t alpha, double x) {
    double sum = 0;
    for (std::size_t s = 0; s <= n; ++s) {
        const auto choose = [](std::size_t a, std::size_t b) {
            return std::tgamma(static_cast<double>(a) + 1) /
                   (std::tgamma(static_cast<double>(b) + 1) * std::tgamma(static_cast<double>(a - b) + 1));
        };
        sum += choose(n + alpha, n - s) * choose(n, s) * std::pow((x - 1) / 2, static_cast<double>(s)) *
               std::pow((x + 1) / 2, static_cast<double>(n - s));
    }
    return sum;
}

Point random_point(std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (;;) {
        const Point xi{uniform(random), uniform(random), uniform(random)};
        if (xi[0] + xi[1] + xi[2] < -1.01) {
            return xi;
        }
    }
}

std::vector<double> random_coefficients(std::size_t order, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    std::vector<double> coefficients(n_modes(order));
    for (double& coefficient : coefficients) {
        coefficient = normal(random);
    }
    return coefficients;
}

Mode sum_of(std::size_t order, const std::vector<double>& coefficients, const Point& xi) {
    std::vector<Mode> modes(coefficients.size());
    evaluate_modes(order, xi, modes);
    Mode sum;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        sum.value += coefficients[i] * modes[i].value;
        for (std::size_t d = 0; d < 3; ++d) {
            sum.gradient[d] += coefficients[i] * modes[i].gradient[d];
        }
    }
    return sum;
}

} // namespace

TEST_CASE("Modes are products of Jacobi polynomials in collapsed coordinates") {
    std::mt19937_64 random(3);
    std::vector<Mode> modes(n_modes(max_order));
    for (int i = 0; i < 20; ++i) {
        const Point xi = random_point(random);
        const double a = 2 * (1 + xi[0]) / (-xi[1] - xi[2]) - 1, b = 2 * (1 + xi[1]) / (1 - xi[2]) - 1, c = xi[2];
        evaluate_modes(max_order, xi, modes);
        std::size_t mode = 0;
        for (std::size_t p = 0; p <= max_order; ++p) {
            for (std::size_t q = 0; p + q <= max_order; ++q) {
                for (std::size_t r = 0; p + q + r <= max_order; ++r, ++mode) {
                    const double expected = jacobi(p, 0, a) * std::pow((1 - b) / 2, static_cast<double>(p)) *
                                            jacobi(q, 2 * p + 1, b) * std::pow((1 - c) / 2, static_cast<double>(p + q)) *
                                            jacobi(r, 2 * (p + q) + 2, c);
                    INFO(p << ' ' << q << ' ' << r);
                    CHECK(modes[mode].value == Approx(expected).margin(1e-11));
                }
            }
        }
        CHECK(mode == modes.size());
    }
}

TEST_CASE("Modes are orthonormal") {
    // Products have degree 6: Gauss-Legendre with 5 points in each collapsed direction is exact, weights included.
    const std::size_t order = 3, n = n_modes(order);
    constexpr double points[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
    constexpr double weights[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                  0.2369268850561891};
    std::vector<Mode> modes(n);
    std::vector<double> factors(n), products(n * n);
    normalisation(order, factors);
    for (int i = 0; i < 125; ++i) {
        const int ia = i % 5, ib = i / 5 % 5, ic = i / 25;
        const double c = points[ic], y = (1 + points[ib]) * (1 - c) / 2 - 1, x = (1 + points[ia]) * (-y - c) / 2 - 1;
        const double weight = weights[ia] * weights[ib] * weights[ic] * (1 - points[ib]) / 2 * std::pow((1 - c) / 2, 2);
        evaluate_modes(order, {x, y, c}, modes);
        for (std::size_t k = 0; k < n * n; ++k) {
            products[k] += weight * factors[k / n] * modes[k / n].value * factors[k % n] * modes[k % n].value;
        }
    }
    for (std::size_t k = 0; k < n * n; ++k) {
        CHECK(products[k] == Approx(k / n == k % n ? 1 : 0).margin(1e-13));
    }
}

TEST_CASE("Gradients of modes are those of their values") {
    std::mt19937_64 random(5);
    const std::vector<double> coefficients = random_coefficients(6, random);
    const double h = 1e-5;
    for (int i = 0; i < 20; ++i) {
        const Point xi = random_point(random);
        const Mode at = sum_of(6, coefficients, xi);
        for (std::size_t d = 0; d < 3; ++d) {
            Point before = xi, after = xi;
            before[d] -= h;
            after[d] += h;
            const double slope = (sum_of(6, coefficients, after).value - sum_of(6, coefficients, before).value) / (2 * h);
            CHECK(at.gradient[d] == Approx(slope).epsilon(1e-6).margin(1e-6));
        }
    }
}

TEST_CASE("Bernstein bounds hold, and are the tighter the flatter the polynomial") {
    std::mt19937_64 random(7);
    const double h = 1e-5;
    for (std::size_t order = 0; order <= max_order; ++order) {
        const BernsteinBounds bounds(order);
        const std::vector<double> coefficients = random_coefficients(order, random);
        const Range range = bounds.range(coefficients);
        const Steepness steepness = bounds.steepness(coefficients);
        for (int i = 0; i < 300; ++i) {
            Point xi = random_point(random);
            const Mode at = sum_of(order, coefficients, xi);
            CHECK(at.value >= range.lower);
            CHECK(at.value <= range.upper);
            CHECK(std::abs(at.gradient[0]) + std::abs(at.gradient[1]) + std::abs(at.gradient[2]) <= steepness.first);
            double bend = 0;
            for (std::size_t d = 0; d < 3; ++d) {
                Point after = xi;
                after[d] += h;
                const Mode beside = sum_of(order, coefficients, after);
                for (std::size_t k = 0; k < 3; ++k) {
                    bend += std::abs(beside.gradient[k] - at.gradient[k]) / h;
                }
            }
            CHECK(bend <= steepness.second * 1.001 + 1e-6);
        }
    }
    // A linear one: exact but for the allowance for rounding.
    const std::vector<double> linear{0.5, 0, 0, 1};
    const Range range = BernsteinBounds(1).range(linear);
    const Mode corners[] = {sum_of(1, linear, {-1, -1, -1}), sum_of(1, linear, {1, -1, -1}), sum_of(1, linear, {-1, 1, -1}),
                            sum_of(1, linear, {-1, -1, 1})};
    double low = corners[0].value, high = low;
    for (const Mode& corner : corners) {
        low = std::min(low, corner.value);
        high = std::max(high, corner.value);
    }
    CHECK(range.lower == Approx(low).epsilon(1e-5));
    CHECK(range.upper == Approx(high).epsilon(1e-5));
}
