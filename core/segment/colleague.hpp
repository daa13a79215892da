/**
 * @file colleague.hpp
 * Roots as eigenvalues: the reference method (shaders/segments/colleague.glsl), in double precision, by Eigen.
 */
#pragma once

#include <core/segment/polynomial.hpp>

namespace elvis::segment {

/** Real roots of p - value in [0, 1], ascending; p by its Chebyshev coefficients. */
std::vector<double> roots_by_colleague(const Polynomial<double>& chebyshev, double value);

} // namespace elvis::segment
