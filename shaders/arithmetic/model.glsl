// Taylor models of first order over a pixel's region: what certified contours rest on.
//
// A region is a set of offsets d in reference coordinates from a point xi: those within the convex hull of four corners (where the
// linearized mapping puts the pixel's corners), enlarged by `beyond` in the maximum norm (what the linearization leaves out). A model of a
// function f over a region says
//
//     f(xi + d) = value + dot(slope, d) + e,   |e| <= remainder,   for every d of the region,
//
// rounding included. Where nothing can be said, value and slope are zero and the remainder is CORE_UNKNOWN; that sticks to all that
// is computed from it. f stays within core_model_reach(model, region) of model.value.
//
// A function g of one model is linearized at its value: with t = f - value, |t| <= T = core_model_reach,
//
//     g(value + t) = g(value) + g'(value) t + q,   |q| <= T^2 / 2 sup |g''|   over [value - T, value + T],
//
// which gives value g(value), slope g'(value) slope, remainder |g'(value)| remainder + |q|. Where an exact form of q is known, it
// stands with the function. See K. Makino, M. Berz, Taylor models and other validated functional inclusion methods (2003).
//
// Rounding: with the unit roundoff u, each result adds CORE_MODEL_OPERATIONS u (|value| + |slope|_1 radius) to its remainder for
// what its own value and slope lose (at most four roundings, a division of 2.5 ulp, or an elementary function of 2 ulp among them);
// the computation of remainders themselves, sums of positive numbers, is covered by a factor CORE_MODEL_UP; and CORE_MODEL_TINY
// stands for what is lost where results below the least normal number become zero.

#ifndef CORE_MODEL
#define CORE_MODEL

#include "arithmetic/precision.glsl"
#include "arithmetic/finite.glsl"
#include "arithmetic/whole_power.glsl"

struct core_region {
    // Offsets from xi of the pixel's corners as predicted linearly.
    elvis_vec3 corner0, corner1, corner2, corner3;
    // Every point of the pixel lies within their convex hull, enlarged by this in the maximum norm.
    elvis_real beyond;
    // At least the maximum norm of every offset of the region.
    elvis_real radius;
};

struct core_model {
    elvis_real value;
    elvis_vec3 slope;
    elvis_real remainder;
};

#define CORE_UNKNOWN elvis_real(3e38LF)
// Remainders above this count as unknown: nothing is drawn with so little knowledge.
#define CORE_LARGEST_REMAINDER elvis_real(1e30LF)
#define CORE_MODEL_OPERATIONS elvis_real(24)
#define CORE_MODEL_UP (elvis_real(1) + elvis_real(128) * CORE_ROUNDOFF)
#if ELVIS_REAL_IS_DOUBLE
#define CORE_MODEL_TINY elvis_real(1e-300LF)
#else
#define CORE_MODEL_TINY elvis_real(1e-36LF)
#endif

elvis_real core_model_norm1(elvis_vec3 v) { return abs(v.x) + abs(v.y) + abs(v.z); }

// Bound of |dot(slope, d)| over the region: a linear function takes its extremes over a hull at the corners.
elvis_real core_model_spread(elvis_vec3 slope, core_region region) {
    const elvis_real s0 = abs(dot(slope, region.corner0)), s1 = abs(dot(slope, region.corner1));
    const elvis_real s2 = abs(dot(slope, region.corner2)), s3 = abs(dot(slope, region.corner3));
    const elvis_real size = core_model_norm1(slope);
    // A dot product loses at most 3 u of the sum of its terms' absolute values.
    return CORE_MODEL_UP * (max(max(s0, s1), max(s2, s3)) + size * (region.beyond + elvis_real(4) * CORE_ROUNDOFF * region.radius)) +
           CORE_MODEL_TINY;
}

// Bound of |f - value| over the region.
elvis_real core_model_reach(core_model f, core_region region) {
    return CORE_MODEL_UP * (core_model_spread(f.slope, region) + f.remainder);
}

// Ends of value +- reach, rounded outward.
elvis_real core_model_least(elvis_real value, elvis_real reach) {
    return value - CORE_MODEL_UP * (reach + elvis_real(2) * CORE_ROUNDOFF * abs(value));
}
elvis_real core_model_most(elvis_real value, elvis_real reach) { return -core_model_least(-value, reach); }

bool core_model_is_known(core_model f) { return f.remainder <= CORE_LARGEST_REMAINDER; }

core_model core_model_unknown() { return core_model(elvis_real(0), elvis_vec3(0), CORE_UNKNOWN); }

// A result with the rounding of its value and slope added to the remainder; unknown unless `is_known` and all of it is finite (an
// overflow of value or slope makes the remainder infinite or NaN).
core_model core_model_result(elvis_real value, elvis_vec3 slope, elvis_real remainder, bool is_known, core_region region) {
    const elvis_real rounding = CORE_MODEL_OPERATIONS * CORE_ROUNDOFF * (abs(value) + core_model_norm1(slope) * region.radius);
    const elvis_real total = CORE_MODEL_UP * (remainder + rounding) + CORE_MODEL_TINY;
    const bool is_good = is_known && core_is_finite(total) && total <= CORE_LARGEST_REMAINDER;
    return core_model(is_good ? value : elvis_real(0), is_good ? slope : elvis_vec3(0), is_good ? total : CORE_UNKNOWN);
}

// Everything that is known is lower <= f <= upper.
core_model core_model_range(elvis_real lower, elvis_real upper, bool is_known, core_region region) {
    const elvis_real value = elvis_real(0.5LF) * lower + elvis_real(0.5LF) * upper;
    const elvis_real half_width = elvis_real(0.5LF) * upper - elvis_real(0.5LF) * lower;
    // The ends are as wrong as any result.
    const elvis_real rounding = CORE_MODEL_OPERATIONS * CORE_ROUNDOFF * (abs(lower) + abs(upper));
    return core_model_result(value, elvis_vec3(0), half_width + rounding, is_known, region);
}

core_model core_model_choose(bool takes_first, core_model first, core_model second) {
    return core_model(takes_first ? first.value : second.value, takes_first ? first.slope : second.slope,
                      takes_first ? first.remainder : second.remainder);
}

core_model core_model_constant(elvis_real value) {
    return core_model(value, elvis_vec3(0), CORE_ROUNDOFF * abs(value) * CORE_MODEL_UP + CORE_MODEL_TINY);
}

// A smooth function from its value and gradient at xi. bounds: x the largest sum of the absolute values of its nine second
// derivatives (|d^T H d| / 2 <= x radius^2 / 2), y the error of the computed value, z the sum of those of the computed gradient's
// entries.
core_model core_model_leaf(elvis_real value, elvis_vec3 gradient, elvis_vec3 bounds, core_region region) {
    const elvis_real remainder = elvis_real(0.5LF) * bounds.x * region.radius * region.radius + bounds.y + bounds.z * region.radius;
    return core_model_result(value, gradient, remainder, true, region);
}

// ---- arithmetic

core_model core_model_add(core_model f, core_model g, core_region region) {
    return core_model_result(f.value + g.value, f.slope + g.slope, f.remainder + g.remainder,
                             core_model_is_known(f) && core_model_is_known(g), region);
}

core_model core_model_negate(core_model f) { return core_model(-f.value, -f.slope, f.remainder); }

core_model core_model_subtract(core_model f, core_model g, core_region region) {
    return core_model_add(f, core_model_negate(g), region);
}

// By a number that is exact.
core_model core_model_scale(elvis_real factor, core_model f, core_region region) {
    return core_model_result(factor * f.value, factor * f.slope, abs(factor) * f.remainder, core_model_is_known(f), region);
}

// (a + t)(b + s) = ab + a s + b t + t s; the slopes' parts of t and s give the linear term, the product of both reaches and the
// remainders the rest: |a| R_g + |b| R_f + T_f T_g.
core_model core_model_multiply(core_model f, core_model g, core_region region) {
    const elvis_real rest = abs(f.value) * g.remainder + abs(g.value) * f.remainder +
                            core_model_reach(f, region) * core_model_reach(g, region);
    // The two products of a slope's entry may cancel, their roundings do not.
    const elvis_real rounding = elvis_real(4) * CORE_ROUNDOFF * region.radius *
                                (abs(f.value) * core_model_norm1(g.slope) + abs(g.value) * core_model_norm1(f.slope));
    return core_model_result(f.value * g.value, f.value * g.slope + g.value * f.slope, rest + rounding,
                             core_model_is_known(f) && core_model_is_known(g), region);
}

// (a + t)^2 = a^2 + 2 a t + t^2
core_model core_model_square(core_model f, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    return core_model_result(f.value * f.value, elvis_real(2) * f.value * f.slope,
                             elvis_real(2) * abs(f.value) * f.remainder + reach * reach, core_model_is_known(f), region);
}

// 1/(a + t) = 1/a - t/a^2 + t^2 / (a^2 (a + t)), where |a| > T.
core_model core_model_reciprocal(core_model f, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real least = core_model_least(abs(f.value), reach);
    const bool is_apart = least > CORE_MODEL_TINY;
    const elvis_real inverse = elvis_real(1) / (is_apart ? f.value : elvis_real(1));
    const elvis_real square = inverse * inverse;
    const elvis_real rest = square * (f.remainder + reach * reach / (is_apart ? least : elvis_real(1)));
    return core_model_result(inverse, -square * f.slope, rest, is_apart && core_model_is_known(f), region);
}

core_model core_model_divide(core_model f, core_model g, core_region region) {
    return core_model_multiply(f, core_model_reciprocal(g, region), region);
}

// sqrt(a + t) = sqrt(a) + t / (2 sqrt(a)) - t^2 / (2 sqrt(a) (sqrt(a) + sqrt(a + t))^2), where a > T. Else all that is known is
// 0 <= sqrt <= sqrt(a + T): that holds wherever there is a root, and keeps it continuous if negative arguments count as zero.
core_model core_model_sqrt(core_model f, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real least = core_model_least(f.value, reach), most = core_model_most(f.value, reach);
    const bool is_apart = least > CORE_MODEL_TINY;
    // Vulkan lets a root be wrong by 4.5 ulp.
    const elvis_real root = sqrt(is_apart ? f.value : elvis_real(1)), least_root = sqrt(is_apart ? least : elvis_real(1));
    const elvis_real half_inverse = elvis_real(0.5LF) / root;
    const elvis_real sum = root + least_root;
    const elvis_real rest = half_inverse * (f.remainder + reach * reach / (sum * sum));
    const core_model series = core_model_result(root, half_inverse * f.slope, rest, is_apart && core_model_is_known(f), region);
    const core_model range = core_model_range(elvis_real(0), sqrt(max(most, elvis_real(0))),
                                              most >= elvis_real(0) && core_model_is_known(f), region);
    return core_model_choose(is_apart, series, range);
}

// The length of a vector of three models; around zero, where it has a kink, a range.
core_model core_model_length(core_model x, core_model y, core_model z, core_region region) {
    return core_model_sqrt(core_model_add(core_model_add(core_model_square(x, region), core_model_square(y, region), region),
                                          core_model_square(z, region), region),
                           region);
}

// ---- functions with a kink

// |a + t| is linear where |a| > T; around zero it is between 0 and |a| + T.
core_model core_model_abs(core_model f, core_region region) {
    const elvis_real reach = CORE_MODEL_UP * core_model_reach(f, region);
    const bool is_negative = f.value < elvis_real(0);
    const core_model linear = core_model(abs(f.value), is_negative ? -f.slope : f.slope, f.remainder);
    const core_model range = core_model_range(elvis_real(0), abs(f.value) + reach, core_model_is_known(f), region);
    return core_model_choose(abs(f.value) > reach, linear, range);
}

// max(f, g) is one of both where f - g is of one sign, else (f + g + |f - g|) / 2.
core_model core_model_max(core_model f, core_model g, core_region region) {
    const core_model difference = core_model_subtract(f, g, region);
    const elvis_real reach = CORE_MODEL_UP * core_model_reach(difference, region);
    const core_model both = core_model_scale(
        elvis_real(0.5LF), core_model_add(core_model_add(f, g, region), core_model_abs(difference, region), region), region);
    return core_model_choose(abs(difference.value) > reach, core_model_choose(difference.value > elvis_real(0), f, g), both);
}

core_model core_model_min(core_model f, core_model g, core_region region) {
    return core_model_negate(core_model_max(core_model_negate(f), core_model_negate(g), region));
}

// ---- elementary functions

core_model core_model_exp(core_model f, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real value = elvis_exp(f.value);
    // g'' grows.
    const elvis_real bend = elvis_exp(core_model_most(f.value, reach));
    return core_model_result(value, value * f.slope, value * f.remainder + elvis_real(0.5LF) * bend * reach * reach,
                             core_model_is_known(f), region);
}

// log(a + t) = log a + t/a - (t/a)^2/2 + ..; the rest is at most (T/a)^2 / (2 (1 - T/a)), where a > T.
core_model core_model_log(core_model f, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real least = core_model_least(f.value, reach);
    const bool is_apart = least > CORE_MODEL_TINY;
    const elvis_real value = is_apart ? f.value : elvis_real(1);
    const elvis_real inverse = elvis_real(1) / value;
    const elvis_real rest = inverse * (f.remainder + elvis_real(0.5LF) * reach * reach / (is_apart ? least : elvis_real(1)));
    return core_model_result(elvis_log(value), inverse * f.slope, rest, is_apart && core_model_is_known(f), region);
}

// The sine or cosine of f from its value and slope there: |g''| <= 1; never outside [-1, 1].
core_model core_model_wave(core_model f, elvis_real value, elvis_real slope, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real rest = abs(slope) * f.remainder + elvis_real(0.5LF) * reach * reach;
    // Beyond the angles that elvis_sin knows, there is no value.
    const bool is_known = core_model_is_known(f) && core_is_finite(value);
    const core_model series = core_model_result(value, slope * f.slope, rest, is_known, region);
    const core_model range = core_model_range(elvis_real(-1), elvis_real(1), is_known, region);
    return core_model_choose(rest < elvis_real(1), series, range);
}
core_model core_model_sin(core_model f, core_region region) {
    return core_model_wave(f, elvis_sin(f.value), elvis_cos(f.value), region);
}
core_model core_model_cos(core_model f, core_region region) {
    return core_model_wave(f, elvis_cos(f.value), -elvis_sin(f.value), region);
}
core_model core_model_tan(core_model f, core_region region) {
    return core_model_divide(core_model_sin(f, region), core_model_cos(f, region), region);
}

// g'' = x / (1 - x^2)^(3/2) grows with |x|. Where the argument reaches 1, the range, for asin grows.
core_model core_model_asin(core_model f, core_region region) {
    const elvis_real one = elvis_real(1);
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real most = core_model_most(abs(f.value), reach);
    const bool is_apart = most < one - elvis_real(4) * CORE_ROUNDOFF;
    const elvis_real value = is_apart ? f.value : elvis_real(0), end = is_apart ? most : elvis_real(0);
    const elvis_real square = (one - value) * (one + value), least_square = (one - end) * (one + end);
    const elvis_real slope = one / sqrt(square);
    // 1 - x loses as much as 1 is rounded by: the square is lessened by more than that.
    const elvis_real sure_square = least_square - elvis_real(2) * CORE_ROUNDOFF;
    const elvis_real bend = end / (sure_square * sqrt(sure_square));
    const elvis_real rest = slope * f.remainder + elvis_real(0.5LF) * bend * reach * reach;
    const core_model series = core_model_result(elvis_asin(value), slope * f.slope, rest, is_apart && core_model_is_known(f), region);
    const elvis_real lower = clamp(core_model_least(f.value, reach), -one, one);
    const elvis_real upper = clamp(core_model_most(f.value, reach), -one, one);
    const core_model range = core_model_range(elvis_asin(lower), elvis_asin(upper), core_model_is_known(f), region);
    return core_model_choose(is_apart && core_model_is_known(series), series, range);
}
core_model core_model_acos(core_model f, core_region region) {
    return core_model_subtract(core_model_constant(elvis_real(1.57079632679489661923LF)), core_model_asin(f, region), region);
}

// |g''| = 2 |x| / (1 + x^2)^2: at most 3 sqrt(3)/8 < 0.65, at |x| = 1/sqrt(3), and falling beyond.
core_model core_model_atan(core_model f, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real least = core_model_least(abs(f.value), reach);
    const elvis_real inverse = elvis_real(1) / (elvis_real(1) + f.value * f.value);
    const elvis_real sum = elvis_real(1) + least * least;
    const elvis_real bend = least > elvis_real(0.58LF) ? elvis_real(2) * least / (sum * sum) : elvis_real(0.65LF);
    const elvis_real rest = inverse * f.remainder + elvis_real(0.5LF) * bend * reach * reach;
    return core_model_result(elvis_atan(f.value), inverse * f.slope, rest, core_model_is_known(f), region);
}

// The angle of (x, y): its gradient is (-y, x) / r^2, and its second derivatives have the norm 1 / r^2, so q <= (T_x^2 + T_y^2) /
// (2 r^2) with the least r. Unknown at the origin and across the cut y = 0, x < 0.
core_model core_model_atan(core_model y, core_model x, core_region region) {
    const elvis_real reach_x = core_model_reach(x, region), reach_y = core_model_reach(y, region);
    const elvis_real least_x = max(core_model_least(abs(x.value), reach_x), elvis_real(0));
    const elvis_real least_y = max(core_model_least(abs(y.value), reach_y), elvis_real(0));
    const elvis_real least_square = least_x * least_x + least_y * least_y;
    const bool is_apart = least_square > CORE_MODEL_TINY &&
                          (least_y > elvis_real(0) || core_model_least(x.value, reach_x) > elvis_real(0)) &&
                          core_model_is_known(x) && core_model_is_known(y);
    const elvis_real square = is_apart ? x.value * x.value + y.value * y.value : elvis_real(1);
    const elvis_real a = x.value / square, b = y.value / square;
    const elvis_real rest = abs(a) * y.remainder + abs(b) * x.remainder +
                            elvis_real(0.5LF) * (reach_x * reach_x + reach_y * reach_y) / (is_apart ? least_square : elvis_real(1));
    const elvis_real rounding = elvis_real(16) * CORE_ROUNDOFF * region.radius *
                                (abs(a) * core_model_norm1(y.slope) + abs(b) * core_model_norm1(x.slope));
    return core_model_result(elvis_atan(y.value, x.value), a * y.slope - b * x.slope, rest + rounding, is_apart, region);
}

// f^n, n >= 2: g'' = n (n-1) x^(n-2) grows with |x|.
core_model core_model_whole_power(core_model f, uint n, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real count = elvis_real(n);
    const elvis_real before = core_whole_power(f.value, n - 1u);
    const elvis_real bend = count * (count - elvis_real(1)) * core_whole_power(core_model_most(abs(f.value), reach), n - 2u);
    const elvis_real rest = count * abs(before) * f.remainder + elvis_real(0.5LF) * bend * reach * reach;
    // n - 1 roundings of the power.
    const elvis_real rounding = elvis_real(2) * count * CORE_ROUNDOFF * abs(before) *
                                (abs(f.value) + count * core_model_norm1(f.slope) * region.radius);
    return core_model_result(before * f.value, count * before * f.slope, rest + rounding, core_model_is_known(f), region);
}

// f^p for f > 0: g'' = p (p-1) x^(p-2) is largest at an end.
core_model core_model_power(core_model f, elvis_real p, core_region region) {
    const elvis_real reach = core_model_reach(f, region);
    const elvis_real least = core_model_least(f.value, reach), most = core_model_most(f.value, reach);
    const bool is_apart = least > CORE_MODEL_TINY && core_model_is_known(f);
    const elvis_real x = is_apart ? f.value : elvis_real(1);
    const elvis_real value = elvis_pow(x, p);
    const elvis_real slope = p * value / x;
    const elvis_real exponent = p - elvis_real(2);
    const elvis_real bend = abs(p * (p - elvis_real(1))) * max(elvis_pow(is_apart ? least : elvis_real(1), exponent),
                                                               elvis_pow(is_apart ? most : elvis_real(1), exponent));
    const elvis_real rest = abs(slope) * f.remainder + elvis_real(0.5LF) * bend * reach * reach;
    // p itself may have been rounded: x^(p (1 + u)) = x^p (1 + u p log x ..), and likewise its slope.
    const elvis_real rounding = elvis_real(2) * CORE_ROUNDOFF * (elvis_real(1) + abs(p * elvis_log(x))) *
                                (abs(value) + abs(slope) * core_model_norm1(f.slope) * region.radius);
    return core_model_result(value, slope * f.slope, rest + rounding, is_apart, region);
}

// f^g = exp(g log f)
core_model core_model_power(core_model f, core_model g, core_region region) {
    return core_model_exp(core_model_multiply(g, core_model_log(f, region), region), region);
}

#endif
