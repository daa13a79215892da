/**
 * @file spaces.hpp
 * Spaces of all shapes and bases for tests, and random numbers and points.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace elvis::test {

inline std::string describe(const native::Space& space) {
    return std::string(native::name(space.shape)) + " " + std::string(native::name(space.basis)) + " " +
           std::to_string(space.order[0]) + " " + std::to_string(space.order[1]) + " " + std::to_string(space.order[2]);
}

/** Every shape and basis at one order. */
inline std::vector<native::Space> spaces_of_order(std::uint32_t order) {
    using native::Basis;
    using native::Shape;
    const std::array<std::uint32_t, 3> orders{order, order, order};
    std::vector<native::Space> spaces;
    for (const Basis basis : {Basis::modified, Basis::orthogonal, Basis::gll_lagrange, Basis::gauss_lagrange})
        spaces.push_back({Shape::hexahedron, basis, orders});
    for (const Shape shape : {Shape::prism, Shape::pyramid, Shape::tetrahedron})
        for (const Basis basis : {Basis::modified, Basis::orthogonal})
            spaces.push_back({shape, basis, orders});
    spaces.push_back({Shape::pyramid, Basis::tensor, orders});
    return spaces;
}

/** Orders that differ between directions, where the shape allows it. */
inline std::vector<native::Space> spaces_of_mixed_order() {
    using native::Basis;
    using native::Shape;
    return {{Shape::hexahedron, Basis::modified, {2, 5, 3}},       {Shape::hexahedron, Basis::orthogonal, {7, 1, 2}},
            {Shape::hexahedron, Basis::gll_lagrange, {1, 2, 6}},   {Shape::prism, Basis::modified, {2, 5, 4}},
            {Shape::prism, Basis::orthogonal, {3, 1, 6}},          {Shape::tetrahedron, Basis::modified, {2, 3, 5}},
            {Shape::tetrahedron, Basis::orthogonal, {1, 4, 4}},    {Shape::pyramid, Basis::tensor, {2, 4, 3}},
            {Shape::hexahedron, Basis::gauss_lagrange, {3, 3, 4}}, {Shape::pyramid, Basis::tensor, {3, 1, 5}}};
}

class Random {
public:
    explicit Random(std::uint32_t seed) : m_engine(seed) {}
    double between(double lower, double upper) { return std::uniform_real_distribution<double>(lower, upper)(m_engine); }
    std::vector<double> numbers(std::size_t n) {
        std::vector<double> result(n);
        for (double& number : result)
            number = between(-1, 1);
        return result;
    }
    /** A point inside the shape. */
    native::Point point(native::Shape shape) { return native::expand(shape, {between(-1, 1), between(-1, 1), between(-1, 1)}); }

private:
    std::mt19937 m_engine;
};

/**
 * Random coefficients of a function that has a single value at the apex of a pyramid: tensor spaces hold others too, whose
 * gradient there is infinite. At eta3 = 1 only the vertex mode A_1 is not zero, so its coefficients are made those of a
 * constant.
 */
inline std::vector<double> smooth_coefficients(const native::Space& space, Random& random) {
    std::vector<double> coefficients = random.numbers(native::n_modes(space));
    if (space.shape != native::Shape::pyramid || space.basis != native::Basis::tensor || space.order[0] == 0)
        return coefficients;
    const double apex = random.between(-1, 1);
    const std::size_t n_r = space.order[2] + 1;
    for (std::uint32_t p = 0; p <= space.order[0]; ++p)
        for (std::uint32_t q = 0; q <= space.order[1]; ++q)
            coefficients[(p * (space.order[1] + 1) + q) * n_r + 1] = p < 2 && q < 2 ? apex : 0;
    return coefficients;
}

} // namespace elvis::test
