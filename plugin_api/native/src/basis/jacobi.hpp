/**
 * @file jacobi.hpp
 * Jacobi polynomials P_n^{a,b} for b = 0 and 1 by their three-term recurrence
 *
 *   P_n(z) = (A_n + B_n z) P_{n-1}(z) - C_n P_{n-2}(z)      (Abramowitz & Stegun 22.7.1)
 *
 * and in scaled form t^n P_n(x/t), a polynomial in x and t:
 *
 *   S_n = (A_n t + B_n x) S_{n-1} - C_n t^2 S_{n-2}
 */
#pragma once

#include <elvis/native/space.hpp>

namespace elvis::native {

/** Largest a: Ortho_C of pyramids, 2 (p + q) + 2 with p, q <= max_order. */
inline constexpr int max_jacobi_a = 4 * static_cast<int>(max_order) + 2;

struct Recurrence {
    double a = 0, b = 0, c = 0;
};

/** Coefficients A_n, B_n, C_n at [n], n <= max_order, for P^{a,b}. Valid for the life of the program. */
const Recurrence* jacobi_recurrence(int a, int b);

/** values[n] and slopes[n] = d/dz for n < count. */
void jacobi(int a, int b, int count, double z, double* values, double* slopes);

/**
 * t^n P_n(x/t) for n < count, with two derivatives along directions in which x and t change as follows:
 * `own`: dx = 1, dt = 0; `later`: dx = 1/2, dt = -1/2. See mode_tables.cpp.
 */
void scaled_jacobi(int a, int b, int count, double x, double t, double* values, double* own, double* later);

} // namespace elvis::native
