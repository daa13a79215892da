/**
 * @file quadrature.hpp
 * Gauss points in extended precision, for tables.
 */
#pragma once

#include <span>

namespace elvis::native {

/** Ascending; the error is a few units of the last place of long double. */
void gauss_legendre(std::span<long double> points);
void gauss_lobatto_legendre(std::span<long double> points);

} // namespace elvis::native
