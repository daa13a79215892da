// Gauss points.
#include <elvis/native/space.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace elvis::native;

TEST_CASE("Gauss-Legendre quadrature with n points is exact to degree 2n - 1") {
    for (const std::size_t n : {1U, 2U, 3U, 7U, 16U, 31U, 64U}) {
        std::vector<double> points(n), weights(n);
        gauss_legendre(points, weights);
        for (std::size_t degree = 0; degree < 2 * n; ++degree) {
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i)
                sum += weights[i] * std::pow(points[i], static_cast<double>(degree));
            CHECK(std::abs(sum - (degree % 2 == 0 ? 2.0 / static_cast<double>(degree + 1) : 0.0)) <
                  2e-15 * static_cast<double>(n));
        }
        for (std::size_t i = 1; i < n; ++i)
            CHECK(points[i] > points[i - 1]);
    }
}

TEST_CASE("Gauss-Lobatto-Legendre points have their known values") {
    std::vector<double> points(5);
    gauss_lobatto_legendre(points);
    CHECK(points[0] == -1);
    CHECK(points[1] == Approx(-std::sqrt(3.0 / 7)).epsilon(1e-15));
    CHECK(points[2] == 0);
    CHECK(points[4] == 1);
    points.resize(31);
    gauss_lobatto_legendre(points);
    for (std::size_t i = 1; i < points.size(); ++i) {
        CHECK(points[i] > points[i - 1]);
        CHECK(points[i] == -points[points.size() - 1 - i]);
    }
}
