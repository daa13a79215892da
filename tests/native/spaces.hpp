/**
 * @file spaces.hpp
 * The spaces and points that the tests run through.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <random>
#include <string>
#include <vector>

namespace elvis::native {

inline std::string text(const Space& space) {
    return std::string(name(space.shape)) + "/" + std::string(name(space.basis)) + " " + std::to_string(space.order[0]) + "," +
           std::to_string(space.order[1]) + "," + std::to_string(space.order[2]);
}

/** Every basis on every shape at orders 0 to 5 and 8, and unequal orders where they exist. */
inline std::vector<Space> test_spaces() {
    std::vector<Space> result;
    const auto add = [&](Shape shape, std::initializer_list<Basis> bases, std::uint32_t p, std::uint32_t q, std::uint32_t r) {
        for (const Basis basis : bases)
            result.push_back({shape, basis, {p, q, r}});
    };
    const auto cube = {Basis::modified, Basis::orthogonal, Basis::gll_lagrange, Basis::gauss_lagrange};
    const auto simplex = {Basis::modified, Basis::orthogonal};
    for (const std::uint32_t n : {0U, 1U, 2U, 3U, 4U, 5U, 8U}) {
        add(Shape::hexahedron, cube, n, n, n);
        add(Shape::quadrilateral, cube, n, n, 0);
        add(Shape::prism, simplex, n, n, n);
        add(Shape::tetrahedron, simplex, n, n, n);
        add(Shape::triangle, simplex, n, n, 0);
        add(Shape::pyramid, {Basis::modified, Basis::orthogonal, Basis::tensor}, n, n, n);
    }
    add(Shape::hexahedron, cube, 1, 4, 2);
    add(Shape::hexahedron, cube, 5, 2, 3);
    add(Shape::quadrilateral, cube, 3, 5, 0);
    add(Shape::prism, simplex, 2, 5, 4);
    add(Shape::prism, simplex, 3, 1, 3);
    add(Shape::tetrahedron, simplex, 2, 3, 5);
    add(Shape::tetrahedron, simplex, 1, 1, 4);
    add(Shape::triangle, simplex, 2, 6, 0);
    add(Shape::pyramid, {Basis::tensor}, 2, 4, 3);
    return result;
}

/** Random points of the closed shape: uniform in collapsed coordinates. */
class Points {
public:
    explicit Points(unsigned seed) : m_random(seed) {}

    double number() { return m_uniform(m_random); }

    Point eta(Shape shape) {
        const double first = number();
        const double second = number();
        return {first, second, dimension(shape) == 3 ? number() : 0.0};
    }

    Point xi(Shape shape) { return expand(shape, eta(shape)); }

    std::vector<double> coefficients(const Space& space) {
        std::vector<double> result(n_modes(space));
        for (double& value : result)
            value = number();
        return result;
    }

private:
    std::mt19937 m_random;
    std::uniform_real_distribution<double> m_uniform{-1.0, 1.0};
};

/** Three components with coefficients in [-1, 1]; continuous at the apex of tensor pyramids. */
inline std::vector<double> random_mapping(const Space& space, Points& points) {
    std::vector<double> result;
    for (int i = 0; i < 3; ++i) {
        std::vector<double> part = points.coefficients(space);
        if (space.basis == Basis::tensor) {
            const std::size_t n2 = space.order[1] + 1, n3 = space.order[2] + 1;
            const double apex = part[1];
            for (std::size_t p = 0; p <= space.order[0]; ++p)
                for (std::size_t q = 0; q < n2; ++q)
                    part[(p * n2 + q) * n3 + 1] = p < 2 && q < 2 ? apex : 0;
        }
        result.insert(result.end(), part.begin(), part.end());
    }
    return result;
}

} // namespace elvis::native
