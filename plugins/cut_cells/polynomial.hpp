/**
 * @file polynomial.hpp
 * Products of Legendre polynomials over the cube [-1,1]^3, up to order 3 in each direction.
 */
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace elvis::cut_cells {

constexpr std::size_t max_order = 3;

/** Coefficients of P_i(xi1) P_j(xi2) P_k(xi3), i, j, k <= order, i fastest, k slowest. */
inline std::size_t n_modes(std::size_t order) { return (order + 1) * (order + 1) * (order + 1); }

struct PolynomialValue {
    double value = 0;
    std::array<double, 3> gradient{};
};

PolynomialValue evaluate(std::size_t order, std::span<const double> modes, const double* xi);

/** Bounds over the cube that hold for coefficients rounded to single precision, too. */
struct PolynomialBounds {
    double lower = 0, upper = 0;
    /** Of the sum of |first| and of |second| derivatives, mixed ones twice. */
    double slope = 0, bend = 0;
};

/**
 * From the largest |P_n| = 1, |P_n'| = n (n+1) / 2 and |P_n''| = (n-1) n (n+1) (n+2) / 8 on [-1,1], all at the ends
 * (DLMF 18.14): sharp where one mode rules, and never wrong.
 */
PolynomialBounds bounds_of(std::size_t order, std::span<const double> modes);

} // namespace elvis::cut_cells
