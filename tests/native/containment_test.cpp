// Spaces contain the polynomials and rational functions that conversion relies on.
#include "spaces.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace elvis::native;

namespace {

using Function = std::function<double(const Point&)>;

/**
 * Largest misfit of the least-squares fit of a function in a space, relative to its largest value. The fit orthogonalises the
 * modes at random points by modified Gram-Schmidt, done twice.
 */
double misfit(const Space& space, const Function& function) {
    Points points(30);
    const std::size_t n = n_modes(space);
    const std::size_t n_points = 3 * n + 20;
    std::vector<std::vector<double>> columns(n + 1, std::vector<double>(n_points));
    std::vector<double> values(n);
    double largest = 0;
    for (std::size_t i = 0; i < n_points; ++i) {
        const Point xi = points.xi(space.shape);
        evaluate_modes(space, xi, values);
        for (std::size_t mode = 0; mode < n; ++mode)
            columns[mode][i] = values[mode];
        columns[n][i] = function(xi);
        largest = std::max(largest, std::abs(columns[n][i]));
    }
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            sum += a[i] * b[i];
        return sum;
    };
    for (std::size_t column = 0; column <= n; ++column) {
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t other = 0; other < column; ++other) {
                const double projection = dot(columns[column], columns[other]);
                for (std::size_t i = 0; i < n_points; ++i)
                    columns[column][i] -= projection * columns[other][i];
            }
        if (column < n) {
            const double length = std::sqrt(dot(columns[column], columns[column]));
            REQUIRE(length > 1e-8); // modes are linearly independent
            for (double& value : columns[column])
                value /= length;
        }
    }
    double result = 0;
    for (const double value : columns[n])
        result = std::max(result, std::abs(value) / largest);
    return result;
}

double monomial(const Point& xi, int a, int b, int c) { return std::pow(xi[0], a) * std::pow(xi[1], b) * std::pow(xi[2], c); }

} // namespace

TEST_CASE("Collapsed spaces contain all polynomials of their order") {
    for (const Basis basis : {Basis::modified, Basis::orthogonal})
        for (const Shape shape : {Shape::tetrahedron, Shape::prism, Shape::pyramid, Shape::triangle}) {
            const std::uint32_t n = 4;
            const bool spatial = dimension(shape) == 3;
            const Space space{shape, basis, {n, n, spatial ? n : 0}};
            CAPTURE(text(space));
            for (int a = 0; a <= 4; ++a)
                for (int b = 0; a + b <= 4; ++b)
                    CHECK(misfit(space, [&](const Point& xi) { return monomial(xi, a, b, spatial ? 4 - a - b : 0); }) < 1e-12);
            CHECK(misfit(space, [&](const Point& xi) { return monomial(xi, 0, 5, 0); }) > 1e-5);
        }
}

TEST_CASE("Hexahedra contain all polynomials of their orders by direction") {
    for (const Basis basis : {Basis::modified, Basis::orthogonal, Basis::gll_lagrange, Basis::gauss_lagrange}) {
        const Space space{Shape::hexahedron, basis, {3, 1, 4}};
        CAPTURE(text(space));
        CHECK(misfit(space, [](const Point& xi) { return monomial(xi, 3, 1, 4); }) < 1e-12);
        CHECK(misfit(space, [](const Point& xi) { return monomial(xi, 0, 2, 0); }) > 1e-3);
    }
}

TEST_CASE("Tensor pyramids contain rational functions of Gmsh and MFEM") {
    const Space first{Shape::pyramid, Basis::tensor, {1, 1, 1}};
    // The fifth function of the rational pyramid: x y / (1 - z) in coordinates with the apex at the origin.
    CHECK(misfit(first, [](const Point& xi) { return (1 + xi[0]) * (1 + xi[1]) / (1 - xi[2]); }) < 1e-12);
    const Space third{Shape::pyramid, Basis::tensor, {3, 3, 3}};
    // Bergot's space of order 3 holds monomials over powers of the height: (x y / z)^(min(i,j)) times a polynomial.
    CHECK(misfit(third, [](const Point& xi) {
              const double t = 1 - xi[2];
              return std::pow((1 + xi[0]) * (1 + xi[1]) / t, 3);
          }) < 1e-12);
    CHECK(misfit(third, [](const Point& xi) { return monomial(xi, 1, 1, 1) + monomial(xi, 3, 0, 0); }) < 1e-12);
    CHECK(misfit(first, [](const Point& xi) { return monomial(xi, 2, 0, 0); }) > 1e-3);
}
