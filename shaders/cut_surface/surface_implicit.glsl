// Where a function of x, y and z changes its sign along a ray.
//
// The part of the ray in question is halved until the function's range over a piece, by interval arithmetic, says that there is no
// zero; or the range of its derivative along the ray says that the function only rises or only falls there, so that its values at
// the piece's ends tell whether there is one. Pieces are gone through from near to far: the first crossing found is the first there
// is. A piece that single (or double) precision cannot halve any more is a crossing if the signs at its ends differ; else the ray
// touches the surface there, as far as can be known, and the pixel is undecided.
//
// The kernel brings core_implicit_value, core_implicit and core_implicit_slopes (core/expression/glsl.hpp), of world coordinates.
//
// Rows: xyz: the reference point, exact in single precision.

#include "cut_surface/surface_hit.glsl"

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

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const elvis_real zero = elvis_real(0);
    const elvis_real from = max(ray.from, min(ray.after, ray.to)), extent = ray.to - from;
    const elvis_real stretch = core_norm1(ray.direction);
    const core_interval dx = core_interval_near(ray.direction.x), dy = core_interval_near(ray.direction.y);
    const core_interval dz = core_interval_near(ray.direction.z);
    uint level = 0u, index = 0u, work = 0u;
    // Ends of the last row of pieces that the surface may touch.
    elvis_real touch_from = CORE_FAR, touch_to = -CORE_FAR;
    bool is_active = ray.from < ray.to && extent > zero;
    while (is_active && work < CORE_WORK_LIMIT) {
        work += 1u;
        const elvis_real width = extent / elvis_real(1u << level);
        const elvis_real low = from + elvis_real(index) * width, high = from + elvis_real(index + 1u) * width;
        const elvis_vec3 a = core_implicit_point(ray, low), b = core_implicit_point(ray, high);
        core_interval gx, gy, gz;
        const core_interval range =
            core_implicit_slopes(core_implicit_coordinate(a.x, b.x, ray.noise), core_implicit_coordinate(a.y, b.y, ray.noise),
                                 core_implicit_coordinate(a.z, b.z, ray.noise), gx, gy, gz);
        const core_interval slope = core_interval_add(core_interval_add(core_interval_multiply(gx, dx), core_interval_multiply(gy, dy)),
                                                      core_interval_multiply(gz, dz));
        const elvis_real at_low = core_implicit_value(a), at_high = core_implicit_value(b);
        const bool is_excluded = range.lower > zero || range.upper < zero;
        const bool is_finite = core_is_finite(at_low) && core_is_finite(at_high);
        const bool is_monotone = is_finite && core_interval_is_bounded(slope) && (slope.lower > zero || slope.upper < zero);
        const bool is_last = level >= CORE_IMPLICIT_LEVELS || width * stretch <= elvis_real(2) * ray.noise;
        const bool has_change = is_finite && (at_low < zero) != (at_high < zero);
        const bool has_zero = !is_excluded && has_change && (is_monotone || is_last);

        // The zero: by the secant, which keeps the ends on either side (Illinois); every third step halves.
        elvis_real s0 = low, s1 = high, f0 = at_low, f1 = at_high, t = abs(at_low) < abs(at_high) ? low : high;
        uint step = 0u;
        while (step < (has_zero ? CORE_IMPLICIT_STEPS : 0u)) {
            const elvis_real fraction = clamp(f0 / (f0 - f1), elvis_real(0.001LF), elvis_real(0.999LF));
            t = s0 + (step % 3u == 2u ? elvis_real(0.5LF) : fraction) * (s1 - s0);
            const elvis_real value = core_implicit_value(core_implicit_point(ray, t));
            const bool is_low = (value < zero) == (f0 < zero);
            f1 = is_low ? elvis_real(0.5LF) * f1 : value;
            f0 = is_low ? value : elvis_real(0.5LF) * f0;
            s0 = is_low ? t : s0;
            s1 = is_low ? s1 : t;
            const bool is_done = value == zero || s1 - s0 <= elvis_real(2) * CORE_ROUNDOFF * max(abs(s0), abs(s1));
            step = is_done ? CORE_IMPLICIT_STEPS : step + 1u;
        }

        // How far rounding may have moved it: the range that the function has at one point as far as can be known, over the slope.
        if (has_zero) {
            const elvis_vec3 x = core_implicit_point(ray, t);
            elvis_real value;
            elvis_vec3 gradient;
            core_implicit(x, value, gradient);
            const core_interval here = core_implicit_range(core_implicit_coordinate(x.x, x.x, ray.noise), core_implicit_coordinate(x.y, x.y, ray.noise),
                                                           core_implicit_coordinate(x.z, x.z, ray.noise));
            const elvis_real steep = abs(dot(gradient, ray.direction));
            const elvis_real most = max(abs(here.lower), abs(here.upper));
            // A pole changes the sign, too.
            const bool is_pole = is_last && !core_interval_is_bounded(here);
            // Pieces right before a crossing cannot be told from it, where nothing is known of the slope.
            const bool is_part = !is_monotone && low - touch_to <= width && t - touch_from <= elvis_real(16) * width;
            const elvis_real error = !is_monotone ? (is_part ? high - touch_from : width)
                                     : steep > zero && most < steep * extent ? most / steep
                                                                             : elvis_real(0.01LF) * extent;
            const bool counts = !is_pole && t > ray.from && t < ray.to && t - elvis_real(2) * error > ray.after;
            best.t = counts ? t : best.t;
            best.error = counts ? error : best.error;
            best.normal_x = counts ? gradient.x : best.normal_x;
            best.normal_y = counts ? gradient.y : best.normal_y;
            best.normal_z = counts ? gradient.z : best.normal_z;
            best.bending = counts ? CORE_FAR : best.bending;
            best.is_hit = counts;
            touch_from = counts && is_part ? CORE_FAR : touch_from;
            best.is_undecided = best.is_undecided || is_pole;
            is_active = !counts;
        }
        // The surface may be touched there.
        const bool touches = !is_excluded && !is_monotone && is_last && !has_change;
        const bool is_apart = touches && low - touch_to > width;
        best.is_undecided = best.is_undecided || (is_apart && touch_from < CORE_FAR);
        touch_from = touches && (is_apart || touch_from >= CORE_FAR) ? low : touch_from;
        touch_to = touches ? high : touch_to;

        const bool goes_down = !is_excluded && !is_monotone && !is_last;
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
    best.is_undecided = best.is_undecided || touch_from < CORE_FAR;
    best.is_cut_short = is_active;
    return best;
}
