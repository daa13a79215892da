// The segment polynomial: a field along a segment, t in [0, 1], as a short polynomial with an estimate of its error. From then on
// work is on the polynomial, not on the field.
//
//   segment_bernstein.glsl   the Bernstein form: range, restriction, values
//   segment_fit.glsl         samples to Chebyshev coefficients, one sample at a time, and the error estimate
//   segment_crossings.glsl   where the polynomial takes given values, in order
//
// Before it stand the tables for a degree (core/segment/tables.hpp), as literals. Loops over them and over coefficients have
// constant bounds, so that compilers unroll them and coefficients live in registers.

#ifndef CORE_SEGMENT_POLYNOMIAL
#define CORE_SEGMENT_POLYNOMIAL

#include "library/segment_bernstein.glsl"
#include "library/segment_fit.glsl"
#include "library/segment_crossings.glsl"

#endif
