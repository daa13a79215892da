// Elementary functions in the precision in use: GLSL has none in double precision, and those of drivers are inexact in single
// precision (Vulkan promises sin and cos to 2^-11 only).
//
// Methods and coefficients are those of FDLIBM and of its single precision versions in FreeBSD's msun, sines and cosines in single
// precision those of Cephes (Moshier). ("Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Permission to use, copy,
// modify, and distribute this software is freely granted, provided that this notice is preserved.") What depends on the precision
// is in math_float.glsl and math_double.glsl: reductions, polynomials, bits.
//
// Largest errors that the test found against an 80-bit reference, in ulp, float / double (tests/shader/math_test.cpp prints them):
//
//   sin, cos    0.9 / 0.8   |x| <= 1e5 / 1.6e6; NaN beyond, where a number says little about its angle
//   exp         0.9 / 0.9
//   log         0.9 / 0.9
//   pow         1.4 / 1.4   as in C: negative x with whole y only
//   atan(x)     0.9 / 0.8   and atan(y, x) 1.8 / 1.8; 2.5 where a division of single precision is not rounded correctly (NVIDIA H200)
//   acos, asin  1.0 / 0.9   NaN beyond [-1, 1]
//
// NaN gives NaN, infinities their limits. Subnormal arguments and results may count as zero, as the device likes.
// There are no branches: CPU drivers run both sides of each anyway.

#ifndef CORE_MATH
#define CORE_MATH

// a + b as rounded sum and its error (Knuth).
void core_two_sum(elvis_real a, elvis_real b, out elvis_real sum, out elvis_real error) {
    precise const elvis_real s = a + b;
    precise const elvis_real b_part = s - a;
    precise const elvis_real e = (a - (s - b_part)) + (b - b_part);
    sum = s;
    error = e;
}

#if ELVIS_REAL_IS_DOUBLE
#include "arithmetic/math_double.glsl"
#else
#include "arithmetic/math_float.glsl"
#endif

// ---- exponential and logarithm

// exp(x + low) for a small `low`: x = k log 2 + r, exp(r) by FDLIBM's rational function.
elvis_real core_exp(elvis_real x, elvis_real low) {
    const elvis_real bounded = clamp(x, elvis_real(-CORE_EXP_LIMIT), elvis_real(CORE_EXP_LIMIT));
    const elvis_real k = floor(bounded * CORE_LOG2_E + CORE_HALF);
    precise const elvis_real high = bounded - k * CORE_EXP_LN2_HIGH;
    precise const elvis_real tail = k * CORE_EXP_LN2_LOW;
    precise const elvis_real r = high - tail;
    const elvis_real c = core_exp_polynomial(r);
    precise const elvis_real y = elvis_real(1) - ((tail - (r * c) / (elvis_real(2) - c)) - high);
    return core_scale(y + y * low, int(k));
}

elvis_real elvis_exp(elvis_real x) { return core_is_nan(x) ? x : core_exp(x, elvis_real(0)); }

elvis_real elvis_log(elvis_real x) {
    int exponent;
    const elvis_real f = core_split(x, exponent) - elvis_real(1);
    const elvis_real k = elvis_real(exponent);
    const elvis_real s = f / (elvis_real(2) + f);
    const elvis_real r = core_log_polynomial(s * s);
    const elvis_real half_square = CORE_HALF * f * f;
    precise const elvis_real result = k * CORE_LN2_HIGH - ((half_square - (s * (half_square + r) + k * CORE_LN2_LOW)) - f);
    const elvis_real at_limits = x > elvis_real(0) ? x : x == elvis_real(0) ? -core_infinity() : core_nan();
    return x > elvis_real(0) && !core_is_infinite(x) ? result : core_is_nan(x) ? x : at_limits;
}

// ---- power

// a * b as rounded product and its error (Dekker).
void core_halves(elvis_real a, out elvis_real high, out elvis_real low) {
    precise const elvis_real scaled = a * CORE_SPLITTER;
    precise const elvis_real h = scaled - (scaled - a);
    precise const elvis_real l = a - h;
    high = h;
    low = l;
}

void core_two_product(elvis_real a, elvis_real b, out elvis_real product, out elvis_real error) {
    elvis_real a_high, a_low, b_high, b_low;
    core_halves(a, a_high, a_low);
    core_halves(b, b_high, b_low);
    precise const elvis_real p = a * b;
    precise const elvis_real e = ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low;
    product = p;
    error = e;
}

// log(x) for positive finite x as a sum of two numbers, to about 8 bits more than the precision:
// 2 atanh(s) = 2 s (1 + z/3 + z^2/5 + ..), z = s^2, s = f / (2 + f).
void core_log_pair(elvis_real x, out elvis_real high, out elvis_real low) {
    int exponent;
    const elvis_real f = core_split(x, exponent) - elvis_real(1);
    const elvis_real k = elvis_real(exponent);
    elvis_real d, d_low;
    core_two_sum(elvis_real(2), f, d, d_low);
    const elvis_real s = f / d;
    elvis_real p, p_low;
    core_two_product(s, d, p, p_low);
    precise const elvis_real s_low = (((f - p) - p_low) - s * d_low) / d;
    elvis_real z, z_low;
    core_two_product(s, s, z, z_low);
    z_low += elvis_real(2) * s * s_low;
    elvis_real third, third_low;
    core_two_product(z, CORE_THIRD, third, third_low);
    third_low += z * CORE_THIRD_LOW + z_low * CORE_THIRD + z * z * core_atanh_polynomial(z);
    elvis_real series, series_low;
    core_two_sum(elvis_real(1), third, series, series_low);
    series_low += third_low;
    elvis_real product, product_low;
    core_two_product(elvis_real(2) * s, series, product, product_low);
    product_low += elvis_real(2) * (s * series_low + s_low * series);
    elvis_real sum, sum_low;
    core_two_sum(k * CORE_POW_LN2_HIGH, product, sum, sum_low);
    sum_low += product_low + k * CORE_POW_LN2_LOW;
    core_two_sum(sum, sum_low, high, low);
}

elvis_real elvis_pow(elvis_real x, elvis_real y) {
    const elvis_real zero = elvis_real(0);
    elvis_real high, low;
    core_log_pair(abs(x), high, low);
    elvis_real product, product_low;
    core_two_product(y, high, product, product_low);
    product_low += y * low;
    const bool in_range = abs(y * high) < elvis_real(CORE_EXP_LIMIT);
    elvis_real result = core_exp(y * high, in_range ? product_low : zero);

    const elvis_real to_zero_or_infinity = y > zero ? zero : core_infinity();
    const bool is_infinite = core_is_infinite(x);
    result = x == zero ? to_zero_or_infinity : is_infinite ? core_infinity() - to_zero_or_infinity : result;
    result = is_infinite && y < zero ? zero : result;
    const bool is_whole = floor(y) == y;
    const bool is_odd = is_whole && floor(CORE_HALF * y) != CORE_HALF * y;
    const bool is_negative = core_sign_bit(x);
    result = is_negative && is_odd ? -result : result;
    result = x < zero && !is_whole && !is_infinite ? core_nan() : result;
    // 1 to any power is 1, and minus 1 to an infinite one.
    result = core_is_infinite(y) && abs(x) == elvis_real(1) ? elvis_real(1) : result;
    result = core_is_nan(x) || core_is_nan(y) ? core_nan() : result;
    return y == zero || x == elvis_real(1) ? elvis_real(1) : result;
}

// ---- sine and cosine

// Sine and cosine of r + low with |r| <= pi/4.
elvis_real core_sin_reduced(elvis_real r, elvis_real low) {
    const elvis_real z = r * r;
    const elvis_real v = z * r;
    precise const elvis_real result = r - ((z * (CORE_HALF * low - v * core_sin_polynomial(z)) - low) - v * CORE_SIN_1);
    return result;
}

elvis_real core_cos_reduced(elvis_real r, elvis_real low) {
    const elvis_real z = r * r;
    const elvis_real half_square = CORE_HALF * z;
    precise const elvis_real w = elvis_real(1) - half_square;
    precise const elvis_real result =
        w + (((elvis_real(1) - w) - half_square) + (z * z * core_cos_polynomial(z) - r * low));
    return result;
}

// Sine of x + quarter * pi/2.
elvis_real core_sin_shifted(elvis_real x, int quarter) {
    const bool in_range = abs(x) <= elvis_real(CORE_SIN_LIMIT);
    elvis_real r, low;
    const int q = core_reduce(in_range ? x : elvis_real(0), r, low) + quarter;
    const elvis_real value = (q & 1) == 0 ? core_sin_reduced(r, low) : core_cos_reduced(r, low);
    return in_range ? ((q & 2) == 0 ? value : -value) : core_nan();
}

elvis_real elvis_sin(elvis_real x) { return core_sin_shifted(x, 0); }
elvis_real elvis_cos(elvis_real x) { return core_sin_shifted(x, 1); }

// ---- arcus functions

// atan(p / q) for q > 0, p >= 0: reduced by 0, atan 1/2, atan 1, atan 3/2 or pi/2 to an argument below 7/16.
elvis_real core_atan_ratio(elvis_real p, elvis_real q) {
    // Scaled so that the sums below do not overflow.
    const elvis_real scale = max(p, q) > CORE_LARGE ? elvis_real(1) / CORE_LARGE : elvis_real(1);
    p *= scale;
    q *= scale;
    const elvis_real sixteenth = elvis_real(0.0625LF) * q;
    elvis_real numerator = p, denominator = q, base = elvis_real(0), base_low = elvis_real(0);
    if (p >= elvis_real(7) * sixteenth) {
        numerator = elvis_real(2) * p - q;
        denominator = elvis_real(2) * q + p;
        base = CORE_ATAN_HALF;
        base_low = CORE_ATAN_HALF_LOW;
    }
    if (p >= elvis_real(11) * sixteenth) {
        numerator = p - q;
        denominator = p + q;
        base = CORE_PI_4;
        base_low = CORE_PI_4_LOW;
    }
    if (p >= elvis_real(19) * sixteenth) {
        numerator = elvis_real(2) * p - elvis_real(3) * q;
        denominator = elvis_real(2) * q + elvis_real(3) * p;
        base = CORE_ATAN_3_2;
        base_low = CORE_ATAN_3_2_LOW;
    }
    if (p >= elvis_real(39) * sixteenth) {
        numerator = -q;
        denominator = p;
        base = CORE_PI_2;
        base_low = CORE_PI_2_LOW;
    }
    const elvis_real t = numerator / denominator;
    const elvis_real z = t * t;
    precise const elvis_real result = base - ((t * z * core_atan_polynomial(z) - base_low) - t);
    return result;
}

elvis_real elvis_atan(elvis_real x) {
    const elvis_real result = core_atan_ratio(min(abs(x), CORE_LARGE), elvis_real(1));
    return core_is_nan(x) ? x : core_sign_bit(x) ? -result : result;
}

// The angle of the point (x, y), in [-pi, pi].
elvis_real elvis_atan(elvis_real y, elvis_real x) {
    elvis_real p = abs(y), q = abs(x);
    const bool both_infinite = core_is_infinite(p) && core_is_infinite(q);
    p = both_infinite ? elvis_real(1) : core_is_infinite(q) ? elvis_real(0) : core_is_infinite(p) ? elvis_real(1) : p;
    q = both_infinite ? elvis_real(1) : core_is_infinite(q) ? elvis_real(1) : core_is_infinite(abs(y)) ? elvis_real(0) : q;
    q = p == elvis_real(0) && q == elvis_real(0) ? elvis_real(1) : q;
    const elvis_real angle = core_atan_ratio(p, q);
    precise const elvis_real obtuse = CORE_PI - (angle - CORE_PI_LOW);
    const elvis_real result = core_sign_bit(x) ? obtuse : angle;
    return core_is_nan(x) || core_is_nan(y) ? core_nan() : core_sign_bit(y) ? -result : result;
}

// asin(x) = x + x R(x^2) for |x| <= 1/2; beyond, pi/2 - 2 asin(sqrt((1 - x) / 2)), whose root is split in high + low.
elvis_real elvis_asin(elvis_real x) {
    const elvis_real a = abs(x);
    const elvis_real t = (elvis_real(1) - a) * CORE_HALF;
    const elvis_real s = sqrt(max(t, elvis_real(0)));
    const elvis_real s_high = core_truncate(s);
    precise const elvis_real s_low = (t - s_high * s_high) / max(s + s_high, CORE_TINY);
    const elvis_real r = core_asin_ratio(a <= CORE_HALF ? x * x : t);
    const elvis_real near = a + a * r;
    precise const elvis_real p = elvis_real(2) * s * r - (CORE_PI_2_LOW - elvis_real(2) * s_low);
    precise const elvis_real q = CORE_PI_4 - elvis_real(2) * s_high;
    precise const elvis_real far = CORE_PI_4 - (p - q);
    const elvis_real result = a <= CORE_HALF ? near : far;
    return a <= elvis_real(1) ? (core_sign_bit(x) ? -result : result) : core_nan();
}

// acos(x) = pi/2 - asin(x) near 0, 2 asin(sqrt((1 - x) / 2)) above 1/2, pi minus that of -x below -1/2.
elvis_real elvis_acos(elvis_real x) {
    const elvis_real a = abs(x);
    const elvis_real t = (elvis_real(1) - a) * CORE_HALF;
    const elvis_real s = sqrt(max(t, elvis_real(0)));
    const elvis_real s_high = core_truncate(s);
    precise const elvis_real s_low = (t - s_high * s_high) / max(s + s_high, CORE_TINY);
    const elvis_real r = core_asin_ratio(a <= CORE_HALF ? x * x : t);
    precise const elvis_real near = CORE_PI_2 - (x - (CORE_PI_2_LOW - x * r));
    precise const elvis_real small = elvis_real(2) * (s_high + (r * s + s_low));
    precise const elvis_real large = CORE_PI - elvis_real(2) * (s + (r * s - CORE_PI_2_LOW));
    const elvis_real far = core_sign_bit(x) ? large : small;
    return a <= elvis_real(1) ? (a <= CORE_HALF ? near : far) : core_nan();
}

#endif
