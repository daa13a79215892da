/**
 * @file chebyshev.hpp
 * Chebyshev polynomials on parts of [-1, 1].
 */
#pragma once

#include <vector>

namespace elvis {

/** T_0(x) .. T_order(x). */
std::vector<double> chebyshev_values(int order, double x);

/**
 * T_n(middle + half a) = sum over m of S[n (order + 1) + m] T_m(a): what turns coefficients on [-1, 1] into those on the
 * interval around `middle`.
 */
std::vector<double> chebyshev_on_interval(int order, double middle, double half);

} // namespace elvis
