/**
 * @file bernstein.hpp
 * One-dimensional factors as Bernstein polynomials.
 */
#pragma once

#include "../file/runs.hpp"

#include <span>

namespace elvis::native {

/**
 * Coefficients b_k of factor(z) = sum b_k C(D,k) l^(D-k) r^k, l = (1-z)/2, r = (1+z)/2, D = coefficients.size() - 1. `order` is
 * that of the direction (number of Lagrange points - 1). Every coefficient is correct to 2^-53 of `bound`, which is
 * returned and is at least the largest |b_k| of every degree D.
 */
double bernstein(const Factor& factor, std::uint32_t order, std::span<double> coefficients);

} // namespace elvis::native
