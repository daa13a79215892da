/**
 * @file evaluate.hpp
 * Several functions of one space at one point.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <span>

namespace elvis::native {

/**
 * Values, and unless the span is empty gradients in xi (entry 3i+j = derivative of function i in direction j), of functions
 * whose coefficients follow one another. The factors of the modes are computed once for all of them.
 */
void evaluate_together(const Space& space, std::span<const double> coefficients, const Point& xi, std::span<double> values,
                       std::span<double> gradients);

} // namespace elvis::native
