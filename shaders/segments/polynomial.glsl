// The segment polynomial: a field along a segment, t in [0, 1], as a short polynomial with an estimate of its error. From then on
// work is on the polynomial, not on the field.
//
//   bernstein.glsl   the Bernstein form: range, restriction, values
//   fit.glsl         samples to Chebyshev coefficients, one sample at a time, and the error estimate
//   crossings.glsl   where the polynomial takes isovalues, in order
//
// Before it stand the tables of a plan, as literals: segment_glsl(plan) of core/segment/tables.hpp. The CPU's twin is core/segment.
//
// Loops run over whole arrays, from 0 to their length, and stages have arrays of their own: that is what makes Mesa unroll them all, so
// that coefficients live in registers. Loops over some entries leave the array in memory: 950 instead of 25 core-nanoseconds for
// de Casteljau's triangle of degree 8.
//
// In single precision stay at degree 8 or below and halve the segment instead: the Bernstein coefficients of T_n reach 46, 184, 733,
// 2927 at n = 6, 8, 10, 12.

#ifndef CORE_FIT_POLYNOMIAL
#define CORE_FIT_POLYNOMIAL

#include "segments/bernstein.glsl"
#include "segments/fit.glsl"
#include "segments/crossings.glsl"

#endif
