// Where a function of x, y and z changes its sign along a ray.
//
// The part of the ray in question is halved until the function's range over an interval, by interval arithmetic, says that there is no
// zero; or the range of its derivative along the ray says that the function only rises or only falls there, so that its values at
// the interval's ends tell whether there is one. Intervals are gone through from near to far: the first crossing found is the first there
// is. An interval that single (or double) precision cannot halve any more is a crossing if the signs at its ends differ; else the ray
// touches the surface there, as far as can be known, and the pixel is undecided. So it is where the function only rises or only falls, but
// rounding decides its sign at an end.
//
// The kernel brings core_implicit_value, core_implicit and core_implicit_slopes (core/expression/glsl.hpp), of world coordinates less an
// origin near the volume.
//
// Rows: xyz: the reference point, relative to that origin.

#include "surface/hit.glsl"
#include "surface/illinois.glsl"

// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 2000u
#define CORE_IMPLICIT_LEVELS 30u
#define CORE_IMPLICIT_STEPS 60u

elvis_vec3 core_implicit_point(core_surface_ray ray, elvis_real t) { return CORE_SHAPE(0).xyz + (ray.origin + t * ray.direction); }

// All that the coordinate can be between two points of the ray, with what rounding does to it.
core_interval core_implicit_coordinate(elvis_real a, elvis_real b, elvis_real noise) {
    const elvis_real width = noise + elvis_real(2) * CORE_ROUNDOFF * max(abs(a), abs(b));
    return core_interval_outward(min(a, b) - width, max(a, b) + width, elvis_real(2));
}

// All that the three coordinates can be between two points.
#define CORE_IMPLICIT_BOX(a, b, noise)                                                                                                    \
    core_implicit_coordinate((a).x, (b).x, noise), core_implicit_coordinate((a).y, (b).y, noise),                                         \
        core_implicit_coordinate((a).z, (b).z, noise)

// What is known of the function on an interval of the ray.
struct core_implicit_interval {
    elvis_real low, high, width;
    // Values at both ends, and whether their signs are known to differ.
    elvis_real at_low, at_high;
    bool has_change;
    // It has no zero; the function only rises or only falls; rounding decides a sign at an end, and with it whether there is a zero.
    bool is_excluded, is_monotone, is_open;
    // It cannot be halved any more.
    bool is_last;
};

// Whether the function may be zero at a point, as far as the point and its value are known.
bool core_may_be_zero(core_surface_ray ray, elvis_vec3 x) {
    const core_interval here = core_implicit_range(CORE_IMPLICIT_BOX(x, x, ray.noise));
    return here.lower <= elvis_real(0) && here.upper >= elvis_real(0);
}

core_implicit_interval core_implicit_interval_at(core_surface_ray ray, elvis_real from, elvis_real extent, uint level, uint index) {
    const elvis_real zero = elvis_real(0);
    core_implicit_interval interval;
    interval.width = extent / elvis_real(1u << level);
    interval.low = from + elvis_real(index) * interval.width;
    interval.high = from + elvis_real(index + 1u) * interval.width;
    const elvis_vec3 a = core_implicit_point(ray, interval.low), b = core_implicit_point(ray, interval.high);
    core_interval gx, gy, gz;
    const core_interval range = core_implicit_slopes(CORE_IMPLICIT_BOX(a, b, ray.noise), gx, gy, gz);
    const core_interval slope = core_interval_add(core_interval_add(core_interval_multiply(gx, core_interval_near(ray.direction.x)),
                                                                    core_interval_multiply(gy, core_interval_near(ray.direction.y))),
                                                  core_interval_multiply(gz, core_interval_near(ray.direction.z)));
    interval.at_low = core_implicit_value(a);
    interval.at_high = core_implicit_value(b);
    interval.is_excluded = range.lower > zero || range.upper < zero;
    const bool is_finite = core_is_finite(interval.at_low) && core_is_finite(interval.at_high);
    interval.is_monotone = is_finite && core_interval_is_bounded(slope) && (slope.lower > zero || slope.upper < zero);
    interval.has_change = is_finite && (interval.at_low < zero) != (interval.at_high < zero);
    interval.is_last = level >= CORE_IMPLICIT_LEVELS || interval.width * core_norm1(ray.direction) <= elvis_real(2) * ray.noise;
    interval.is_open = false;
    if (!interval.is_excluded && interval.is_monotone) {
        // The ray may begin at a crossing that was found before.
        interval.is_open = (interval.low > from && core_may_be_zero(ray, a)) || core_may_be_zero(ray, b);
    }
    return interval;
}

elvis_real core_implicit_zero(core_surface_ray ray, core_implicit_interval interval, bool has_zero) {
    core_bracket bracket = core_bracket(interval.low, interval.high, interval.at_low, interval.at_high);
    elvis_real t = core_better_end(bracket);
    uint step = 0u;
    while (step < (has_zero ? CORE_IMPLICIT_STEPS : 0u)) {
        t = core_next_place(bracket, step, clamp(core_secant_fraction(bracket), elvis_real(0.001LF), elvis_real(0.999LF)));
        const elvis_real value = core_implicit_value(core_implicit_point(ray, t));
        core_take_value(t, value, bracket);
        const bool is_done = value == elvis_real(0) ||
                             bracket.high - bracket.low <= elvis_real(2) * CORE_ROUNDOFF * max(abs(bracket.low), abs(bracket.high));
        step = is_done ? CORE_IMPLICIT_STEPS : step + 1u;
    }
    return t;
}

// The intervals side by side, found last, in which the surface may be touched; from CORE_FAR: none.
struct core_touch {
    elvis_real from, to;
};

// Takes the zero at t, unless it is a pole or not wanted. Returns whether it is taken.
bool core_take_zero(core_surface_ray ray, core_implicit_interval interval, elvis_real extent, elvis_real t, inout core_touch touch,
                    inout core_hit best) {
    const elvis_vec3 x = core_implicit_point(ray, t);
    elvis_real value;
    elvis_vec3 gradient;
    core_implicit(x, value, gradient);
    // How far rounding may have moved it: the range that the function has at one point as far as can be known, over the slope.
    const core_interval here = core_implicit_range(CORE_IMPLICIT_BOX(x, x, ray.noise));
    const elvis_real steep = abs(dot(gradient, ray.direction)), most = max(abs(here.lower), abs(here.upper));
    // A pole changes the sign, too.
    const bool is_pole = interval.is_last && !core_interval_is_bounded(here);
    // Intervals right before a crossing cannot be told from it, where nothing is known of the slope.
    const bool joins_touch =
        !interval.is_monotone && interval.low - touch.to <= interval.width && t - touch.from <= elvis_real(16) * interval.width;
    const elvis_real error = !interval.is_monotone ? (joins_touch ? interval.high - touch.from : interval.width)
                             : steep > elvis_real(0) && most < steep * extent ? most / steep
                                                                              : elvis_real(0.01LF) * extent;
    const bool is_taken = !is_pole && core_is_counted(ray, t, error, best);
    core_take_hit(is_taken, t, error, gradient, CORE_FAR, best);
    touch.from = is_taken && joins_touch ? CORE_FAR : touch.from;
    best.is_undecided = best.is_undecided || is_pole;
    return is_taken;
}

// Where the surface may be touched in the interval. Returns whether intervals before it, apart from it, stay undecided.
bool core_take_touch(core_implicit_interval interval, inout core_touch touch) {
    const bool touches = !interval.is_excluded && !interval.is_monotone && interval.is_last && !interval.has_change;
    const bool is_apart = touches && interval.low - touch.to > interval.width;
    const bool is_left_behind = is_apart && touch.from < CORE_FAR;
    touch.from = touches && (is_apart || touch.from >= CORE_FAR) ? interval.low : touch.from;
    touch.to = touches ? interval.high : touch.to;
    return is_left_behind;
}

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const elvis_real from = core_first_t(ray), extent = ray.to - from;
    uint level = 0u, index = 0u, work = 0u;
    core_touch touch = core_touch(CORE_FAR, -CORE_FAR);
    bool is_active = ray.from < ray.to && extent > elvis_real(0);
    while (is_active && work < CORE_WORK_LIMIT) {
        work += 1u;
        const core_implicit_interval interval = core_implicit_interval_at(ray, from, extent, level, index);
        const bool has_zero = !interval.is_excluded && interval.has_change && (interval.is_monotone || interval.is_last);
        const elvis_real t = core_implicit_zero(ray, interval, has_zero);
        if (has_zero) {
            is_active = !core_take_zero(ray, interval, extent, t, touch, best);
        }
        best.is_undecided = core_take_touch(interval, touch) || interval.is_open || best.is_undecided;
        const bool goes_down = !interval.is_excluded && !interval.is_monotone && !interval.is_last;
        level += goes_down ? 1u : 0u;
        index = goes_down ? 2u * index : index + 1u;
        // Where the second half is done with, so is the whole.
        while (!goes_down && level > 0u && (index & 1u) == 0u) {
            index /= 2u;
            level -= 1u;
        }
        is_active = is_active && (level > 0u || index == 0u);
        if (!is_active) {
            break;
        }
    }
    best.is_undecided = best.is_undecided || touch.from < CORE_FAR;
    best.is_cut_short = is_active;
    return best;
}
