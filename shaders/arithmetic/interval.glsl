// Interval arithmetic: ranges of functions over boxes that surely hold.
//
// There is no directed rounding on devices: every result is widened outward, by two units in the last place (what rounding to
// nearest, or even towards zero, can lose), three for division (Vulkan promises 2.5), six for square roots (4.5), four for the
// elementary functions of arithmetic/math.glsl (2), and by CORE_INTERVAL_TINY for results that devices may take for zero. All of it is
// `precise`, so that no compiler rearranges it. Ends are never infinite: an interval that reaches beyond +-CORE_INTERVAL_END says
// nothing on that side, and is cut there. Where a function has no value on part of an interval (root or logarithm of negative
// numbers) the result bounds the values that exist.
//
// See R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis (2009).

#ifndef CORE_INTERVAL
#define CORE_INTERVAL

#include "arithmetic/precision.glsl"
#include "arithmetic/finite.glsl"
#include "arithmetic/whole_power.glsl"

struct core_interval {
    elvis_real lower, upper;
};

#define CORE_INTERVAL_END elvis_real(3e38LF)
#if ELVIS_REAL_IS_DOUBLE
#define CORE_INTERVAL_TINY elvis_real(1e-300LF)
#else
#define CORE_INTERVAL_TINY elvis_real(1e-37LF)
#endif

core_interval core_interval_whole() { return core_interval(-CORE_INTERVAL_END, CORE_INTERVAL_END); }

// Widened by `ulps` units in the last place; NaN and infinities become the ends. Two units of roundoff are one unit in the last
// place at most.
core_interval core_interval_outward(elvis_real lower, elvis_real upper, elvis_real ulps) {
    const elvis_real relative = elvis_real(2) * ulps * CORE_ROUNDOFF;
    precise const elvis_real below = lower - (relative * abs(lower) + CORE_INTERVAL_TINY);
    precise const elvis_real above = upper + (relative * abs(upper) + CORE_INTERVAL_TINY);
    return core_interval(core_is_finite(below) ? max(below, -CORE_INTERVAL_END) : -CORE_INTERVAL_END,
                         core_is_finite(above) ? min(above, CORE_INTERVAL_END) : CORE_INTERVAL_END);
}

// An end that was cut must not be computed with as if it were a number.
bool core_interval_is_bounded(core_interval a) { return a.lower > -CORE_INTERVAL_END && a.upper < CORE_INTERVAL_END; }

core_interval core_interval_number(elvis_real value) { return core_interval(value, value); }
// For a number that lost something when it was rounded.
core_interval core_interval_near(elvis_real value) { return core_interval_outward(value, value, elvis_real(2)); }

core_interval core_interval_add(core_interval a, core_interval b) {
    precise const elvis_real lower = a.lower + b.lower;
    precise const elvis_real upper = a.upper + b.upper;
    const core_interval sum = core_interval_outward(lower, upper, elvis_real(2));
    return core_interval(a.lower <= -CORE_INTERVAL_END || b.lower <= -CORE_INTERVAL_END ? -CORE_INTERVAL_END : sum.lower,
                         a.upper >= CORE_INTERVAL_END || b.upper >= CORE_INTERVAL_END ? CORE_INTERVAL_END : sum.upper);
}

core_interval core_interval_negate(core_interval a) { return core_interval(-a.upper, -a.lower); }
core_interval core_interval_subtract(core_interval a, core_interval b) { return core_interval_add(a, core_interval_negate(b)); }

core_interval core_interval_multiply(core_interval a, core_interval b) {
    precise const elvis_real ll = a.lower * b.lower;
    precise const elvis_real lu = a.lower * b.upper;
    precise const elvis_real ul = a.upper * b.lower;
    precise const elvis_real uu = a.upper * b.upper;
    // Products that overflow are caught one by one: min and max need not hand on what is not a number.
    const bool is_sound = core_interval_is_bounded(a) && core_interval_is_bounded(b) && core_is_finite(ll) && core_is_finite(lu) &&
                          core_is_finite(ul) && core_is_finite(uu);
    const core_interval product =
        core_interval_outward(min(min(ll, lu), min(ul, uu)), max(max(ll, lu), max(ul, uu)), elvis_real(2));
    return core_interval(is_sound ? product.lower : -CORE_INTERVAL_END, is_sound ? product.upper : CORE_INTERVAL_END);
}

core_interval core_interval_divide(core_interval a, core_interval b) {
    const bool is_apart = b.lower > CORE_INTERVAL_TINY || b.upper < -CORE_INTERVAL_TINY;
    const elvis_real low = is_apart ? b.lower : elvis_real(1), high = is_apart ? b.upper : elvis_real(1);
    precise const elvis_real ll = a.lower / low;
    precise const elvis_real lu = a.lower / high;
    precise const elvis_real ul = a.upper / low;
    precise const elvis_real uu = a.upper / high;
    const bool is_sound = is_apart && core_interval_is_bounded(a) && core_interval_is_bounded(b) && core_is_finite(ll) &&
                          core_is_finite(lu) && core_is_finite(ul) && core_is_finite(uu);
    const core_interval quotient =
        core_interval_outward(min(min(ll, lu), min(ul, uu)), max(max(ll, lu), max(ul, uu)), elvis_real(3));
    return core_interval(is_sound ? quotient.lower : -CORE_INTERVAL_END, is_sound ? quotient.upper : CORE_INTERVAL_END);
}

// Tighter than a product: a square is not negative.
core_interval core_interval_square(core_interval a) {
    const elvis_real least = a.lower > elvis_real(0) ? a.lower : a.upper < elvis_real(0) ? -a.upper : elvis_real(0);
    const elvis_real most = max(abs(a.lower), abs(a.upper));
    precise const elvis_real lower = least * least;
    precise const elvis_real upper = most * most;
    const core_interval result = core_interval_outward(lower, upper, elvis_real(2));
    return core_interval(core_is_finite(lower) ? max(result.lower, elvis_real(0)) : CORE_INTERVAL_END,
                         core_interval_is_bounded(a) ? result.upper : CORE_INTERVAL_END);
}

core_interval core_interval_sqrt(core_interval a) {
    const core_interval result =
        core_interval_outward(sqrt(max(a.lower, elvis_real(0))), sqrt(max(a.upper, elvis_real(0))), elvis_real(6));
    return core_interval(max(result.lower, elvis_real(0)), a.upper >= CORE_INTERVAL_END ? CORE_INTERVAL_END : result.upper);
}

core_interval core_interval_abs(core_interval a) {
    const elvis_real least = a.lower > elvis_real(0) ? a.lower : a.upper < elvis_real(0) ? -a.upper : elvis_real(0);
    return core_interval(least, max(abs(a.lower), abs(a.upper)));
}
core_interval core_interval_min(core_interval a, core_interval b) {
    return core_interval(min(a.lower, b.lower), min(a.upper, b.upper));
}
core_interval core_interval_max(core_interval a, core_interval b) {
    return core_interval(max(a.lower, b.lower), max(a.upper, b.upper));
}
// The smallest interval that contains both.
core_interval core_interval_union(core_interval a, core_interval b) {
    return core_interval(min(a.lower, b.lower), max(a.upper, b.upper));
}

// ---- elementary functions

core_interval core_interval_exp(core_interval a) {
    // Beyond the limit exp overflows or vanishes; clamped arguments keep the order.
    const core_interval result = core_interval_outward(elvis_exp(a.lower), elvis_exp(a.upper), elvis_real(4));
    const elvis_real lower = result.lower <= -CORE_INTERVAL_END ? elvis_real(0) : max(result.lower, elvis_real(0));
    return core_interval(lower, result.upper);
}

core_interval core_interval_log(core_interval a) {
    const core_interval result = core_interval_outward(elvis_log(max(a.lower, CORE_INTERVAL_TINY)),
                                                       elvis_log(max(a.upper, CORE_INTERVAL_TINY)), elvis_real(4));
    return core_interval(a.lower > CORE_INTERVAL_TINY ? result.lower : -CORE_INTERVAL_END,
                         a.upper >= CORE_INTERVAL_END ? CORE_INTERVAL_END : result.upper);
}

// Largest arguments that sine and cosine are computed for; beyond, the range is all of [-1, 1].
#define CORE_INTERVAL_ANGLE elvis_real(1e4LF)

// Sine on an interval: its extremes are the ends and the maxima at pi/2 + 2 pi k, the minima at -pi/2 + 2 pi k, that lie within, or
// so close that rounding cannot tell.
core_interval core_interval_sin(core_interval a) {
    const bool is_small = a.lower > -CORE_INTERVAL_ANGLE && a.upper < CORE_INTERVAL_ANGLE;
    const elvis_real lower = is_small ? a.lower : elvis_real(0), upper = is_small ? a.upper : elvis_real(0);
    const elvis_real at_lower = elvis_sin(lower), at_upper = elvis_sin(upper);
    // In periods; rounding takes a few units in the last place from a period's number.
    const elvis_real per_turn = elvis_real(0.15915494309189533577LF), quarter = elvis_real(0.25LF);
    const elvis_real slack = elvis_real(8) * CORE_ROUNDOFF * (elvis_real(1) + max(abs(lower), abs(upper)));
    const elvis_real first = lower * per_turn - slack, last = upper * per_turn + slack;
    const bool has_maximum = floor(last - quarter) >= first - quarter;
    const bool has_minimum = floor(last + quarter) >= first + quarter;
    const core_interval ends = core_interval_outward(min(at_lower, at_upper), max(at_lower, at_upper), elvis_real(4));
    const elvis_real one = elvis_real(1);
    return core_interval(!is_small || has_minimum ? -one : max(ends.lower, -one),
                         !is_small || has_maximum ? one : min(ends.upper, one));
}

core_interval core_interval_cos(core_interval a) {
    // cos x = sin(x + pi/2); the sum is widened like any other.
    const elvis_real quarter_turn = elvis_real(1.57079632679489661923LF);
    return core_interval_sin(core_interval_add(a, core_interval_near(quarter_turn)));
}

core_interval core_interval_atan(core_interval a) {
    return core_interval_outward(elvis_atan(a.lower), elvis_atan(a.upper), elvis_real(4));
}
core_interval core_interval_asin(core_interval a) {
    const elvis_real one = elvis_real(1);
    return core_interval_outward(elvis_asin(clamp(a.lower, -one, one)), elvis_asin(clamp(a.upper, -one, one)), elvis_real(4));
}
core_interval core_interval_acos(core_interval a) {
    const elvis_real one = elvis_real(1);
    return core_interval_outward(elvis_acos(clamp(a.upper, -one, one)), elvis_acos(clamp(a.lower, -one, one)), elvis_real(4));
}

core_interval core_interval_tan(core_interval a) { return core_interval_divide(core_interval_sin(a), core_interval_cos(a)); }

// The angle of the points of a box: by atan where the box lies on one side of an axis, else all angles.
core_interval core_interval_atan(core_interval y, core_interval x) {
    const elvis_real zero = elvis_real(0), pi = elvis_real(3.14159265358979323846LF);
    const core_interval right = core_interval_atan(core_interval_divide(y, x));
    const core_interval turned = core_interval_negate(core_interval_atan(core_interval_divide(x, y)));
    const core_interval quarter_turn = core_interval_near(elvis_real(1.57079632679489661923LF));
    const core_interval above = core_interval_add(quarter_turn, turned);
    const core_interval below = core_interval_subtract(turned, quarter_turn);
    const core_interval all = core_interval_outward(-pi, pi, elvis_real(4));
    const bool is_above = y.lower > zero, is_below = y.upper < zero, is_right = x.lower > zero;
    return core_interval(is_above ? above.lower : is_below ? below.lower : is_right ? right.lower : all.lower,
                         is_above ? above.upper : is_below ? below.upper : is_right ? right.upper : all.upper);
}

// x^n for a whole number n >= 1: growing where n is odd, growing in |x| where it is even. Each product of positive numbers loses an
// ulp at most (towards zero), which is why the result is widened by n + 1.
core_interval core_interval_whole_power(core_interval a, uint n) {
    const bool is_odd = (n & 1u) != 0u;
    const core_interval size = core_interval_abs(a);
    const core_interval base = core_interval(is_odd ? a.lower : size.lower, is_odd ? a.upper : size.upper);
    const elvis_real lower = core_whole_power(base.lower, n), upper = core_whole_power(base.upper, n);
    const core_interval result = core_interval_outward(lower, upper, elvis_real(n + 1u));
    const elvis_real least = is_odd ? result.lower : max(result.lower, elvis_real(0));
    // A power that overflows is none that vanishes: its sign is that of the end.
    return core_interval(base.lower <= -CORE_INTERVAL_END ? -CORE_INTERVAL_END : least,
                         base.upper >= CORE_INTERVAL_END ? CORE_INTERVAL_END : result.upper);
}

// a^b = exp(b log a) where a > 0, and 0 beside it.
core_interval core_interval_power(core_interval a, core_interval b) {
    const core_interval positive = core_interval(max(a.lower, elvis_real(0)), max(a.upper, elvis_real(0)));
    const core_interval power = core_interval_exp(core_interval_multiply(b, core_interval_log(positive)));
    return core_interval(a.lower > CORE_INTERVAL_TINY ? power.lower : elvis_real(0), power.upper);
}

#endif
