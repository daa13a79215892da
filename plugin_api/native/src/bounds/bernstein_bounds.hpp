/**
 * @file bernstein_bounds.hpp
 * Bounds of derivatives in tetrahedra and prisms from Bernstein coefficients: sharper than weights for smooth fields.
 */
#pragma once

#include "../basis/matrix.hpp"
#include "derivative_weights.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis::native::device {

/**
 * A polynomial of degree n on a simplex is sum_a b_a B_a with Bernstein's B_a >= 0, sum B_a = 1, so it lies between its
 * smallest and largest coefficient, and sum_ij |d_ij f| <= max_a sum_ij |b_a of d_ij f|. Derivatives are differences of
 * coefficients.
 *
 * The device's functions have exact coefficients: P_n^{a,0} has (-1)^(n-i) C(n+a, i), i = 0 .. n (Farouki, "The Bernstein
 * polynomial basis", 2012, section 5), powers of t and s raise the degree, and with the barycentric coordinates l_0 .. l_3,
 * s = l_0 + l_1, t = l_0 + l_1 + l_2. Written for a simplex of 2 or 3 dimensions and degree n, with i, j, k the exponents of
 * l_1, l_2, l_3, the coefficients are products of factors that depend on (p, i), (q, j) and (r, k).
 *
 * A prism is the triangle of directions 1 and 3 for each Chebyshev polynomial in direction 2, whose bounds are multiplied with
 * the coefficients and added.
 */
class BernsteinBounds {
public:
    explicit BernsteinBounds(const DeviceSpace& space);

    /** Whether there are bounds for the shape: else bound() must not be called. */
    bool is_usable() const { return m_degree > 0; }

    /** For device coefficients in the order of the record. */
    DerivativeBound bound(std::span<const double> coefficients) const;

private:
    /** Positions, among coefficients of degree n - 1 (first) or n - 2 (second), of those that differences are taken of. */
    void find_differences(int n_corners);

    /** 0 where not usable. */
    int m_degree = 0;
    std::size_t m_n_corners = 0;
    /** One layer of modes to the coefficients of degree n. */
    Matrix m_matrix;
    std::size_t m_n_layers = 1;
    /** Largest entry of each column of the matrix. */
    std::vector<double> m_largest;
    /** For every coefficient of degree n - 1, its position plus each corner; of degree n - 2, plus each pair of corners. */
    std::vector<std::array<std::uint32_t, 4>> m_first;
    std::vector<std::array<std::array<std::uint32_t, 4>, 4>> m_second;
};

} // namespace elvis::native::device
