// The volume rendering integral of a polynomial. A step of a segment is cut into sections, in each of which one piece of the transfer
// function holds the polynomial: density and colour are then polynomials, and so is the inner integral, exactly. With the absorbed share
// O = 1 - exp(-D) the outer one is
//
//     integral of (c + c' (p - from)) dO  =  c O + c' integral of (p - from) dO,
//
// which is exact where the colour is constant; else one number is left to quadrature, whatever the number of channels.
//
// The kernel brings volume/volume_light.glsl and the tables of degree 5 (core/segment/tables.hpp).

#include "segments/bernstein.glsl"

// Of what the kernel does in one dispatch.
#define CORE_WORK_A_STEP 3u
#define CORE_WORK_AN_ITERATION 6u
// Breakpoints met and intervals halved in one step. After this many, the step is given up and counts as inexact.
#define CORE_MOST_ITERATIONS 256u
#define CORE_BREAKPOINT_ITERATIONS 48u
// How fast the error of a step's polynomial changes with the parameter, over its largest: t^2 (1 - t)^2 (t - a)^2, of a quintic, by 6.9
// where a = CORE_INNER_AT, and rounding that changes its sign from sample to sample by as much.
#define CORE_ERROR_CHANGE elvis_real(8)
// Of the parameter: intervals are not halved further.
#define CORE_SMALLEST_INTERVAL elvis_real(1.52587890625e-5LF)
// Share of what a step may be off that quadrature may be off in a section: little, as its estimate may be far too small where both rules
// happen to agree (with 1/32, spheres of peaks at tolerance 1e-8 were off by up to 7e-8 in one pixel of 50000).
#define CORE_QUADRATURE_SHARE elvis_real(0.001953125LF)

// Gauss' rule with three points on [0, 1], and the integrals up to these of the parabola through the values there: with these as depths
// the outer integral is of order 6 as well (the coefficients are those of Gauss' method for differential equations; E. Hairer, S. P.
// Norsett, G. Wanner, Solving Ordinary Differential Equations I, table II.7.4).
#define CORE_GAUSS_AT elvis_vec3(0.11270166537925831148LF, 0.5LF, 0.88729833462074168852LF)
#define CORE_GAUSS_WEIGHTS elvis_vec3(0.27777777777777777778LF, 0.44444444444444444444LF, 0.27777777777777777778LF)
// Distance of the ends over that of the outer nodes.
#define CORE_GAUSS_PER_NODE elvis_real(1.29099444873580562839LF)
// Of the square of a section's cubic term: 17 times the error for exp(h).
#define CORE_CUBIC_MARGIN elvis_real(0.03125LF)
#define CORE_GAUSS_TO_FIRST elvis_vec3(0.13888888888888888889LF, -0.03597666752493890346LF, 0.00978944401530832605LF)
#define CORE_GAUSS_TO_MIDDLE elvis_vec3(0.30026319498086459244LF, 0.22222222222222222222LF, -0.02248541720308681466LF)
#define CORE_GAUSS_TO_LAST elvis_vec3(0.26798833376246945173LF, 0.48042111196938334790LF, 0.13888888888888888889LF)

// exp(-depth), of a depth that is not negative: a part in 1e7 is enough, and lighter than elvis_exp.
elvis_real core_transmittance(elvis_real depth) {
#if ELVIS_REAL_IS_DOUBLE
    return elvis_exp(-depth);
#else
    const float x = max(-depth, -87.0), k = floor(x * 1.44269504 + 0.5);
    const float r = (x - k * CORE_EXP_LN2_HIGH) - k * CORE_EXP_LN2_LOW;
    const float tail = 0.5 + r * (0.16666667 + r * (0.041666668 + r * (0.0083333338 + r * (0.0013888889 + r * 0.00019841270))));
    return ((1.0 + r) + r * r * tail) * intBitsToFloat((int(k) + 127) << 23);
#endif
}

// The polynomial with these powers of the parameter.
elvis_real core_power_value(const core_polynomial powers, elvis_real t) {
    elvis_real sum = powers.c[CORE_FIT_DEGREE];
    for (int i = 1; i < CORE_FIT_SIZE; ++i) {
        sum = sum * t + powers.c[CORE_FIT_DEGREE - i];
    }
    return sum;
}

elvis_real core_power_slope(const core_polynomial powers, elvis_real t) {
    elvis_real sum = elvis_real(0);
    for (int i = 0; i < CORE_FIT_DEGREE; ++i) {
        sum = sum * t + elvis_real(CORE_FIT_DEGREE - i) * powers.c[CORE_FIT_DEGREE - i];
    }
    return sum;
}

// Half of the most that its slope changes by over [0, 1].
elvis_real core_power_bend(const core_polynomial powers) {
    elvis_real sum = elvis_real(0);
    for (int i = 2; i < CORE_FIT_SIZE; ++i) {
        sum += elvis_real((i * (i - 1)) / 2) * abs(powers.c[i]);
    }
    return sum;
}

// A polynomial that stands for the field along a step.
struct core_fitted {
    // In the Bernstein basis, and by powers of the step's parameter.
    core_polynomial p, powers;
    // What it is off, and how much of that is rounding; how large something may be that samples have missed.
    elvis_real error, rounding, unseen;
};

// The light of a section.
struct core_attenuation {
    // exp(-D), D the depth of all of it; the integral of (p - from) dO, and what that is off.
    elvis_real transmittance, weighted, missed;
};

// From `first` to `last`, which are values less the piece's `from`, over `length` of the ray, by Gauss' rule.
//
// The error is estimated from Simpson's rule, which needs but the ends besides. With h the section's length Simpson's error is about
// h^5 / 2880 times the fourth derivative, Gauss' h^7 / 2016000 times the sixth: for exp(h) that is 0.08 of the 3/2th power of the other.
// A few hundred times as much is taken. Where the fourth derivative changes its sign both rules may agree by chance. So the third one
// counts, too: it makes the differences of ends and of nodes differ by h^3 / 60 times that, and for exp(h) Gauss' error is 0.0018 of the
// square.
core_attenuation core_attenuate(const core_polynomial powers, const core_held_piece held, elvis_real from, elvis_real width,
                                elvis_real first, elvis_real last, elvis_real length) {
    const elvis_vec3 at = from + width * CORE_GAUSS_AT;
    const elvis_vec3 q = elvis_vec3(core_power_value(powers, at.x), core_power_value(powers, at.y), core_power_value(powers, at.z)) -
                         held.from;
    const elvis_vec3 density = held.density + held.density_slope * q;
    const elvis_vec3 transmittance = elvis_vec3(core_transmittance(max(length * dot(CORE_GAUSS_TO_FIRST, density), elvis_real(0))),
                                                core_transmittance(max(length * dot(CORE_GAUSS_TO_MIDDLE, density), elvis_real(0))),
                                                core_transmittance(max(length * dot(CORE_GAUSS_TO_LAST, density), elvis_real(0))));
    core_attenuation section;
    section.transmittance = core_transmittance(max(length * dot(CORE_GAUSS_WEIGHTS, density), elvis_real(0)));
    const elvis_vec3 inside = q * density * transmittance;
    const elvis_real begin = first * (held.density + held.density_slope * first);
    const elvis_real end = last * (held.density + held.density_slope * last) * section.transmittance;
    const elvis_real gauss = dot(CORE_GAUSS_WEIGHTS, inside);
    const elvis_real simpson = (begin + elvis_real(4) * inside.y + end) * elvis_real(0.16666666666666666667LF);
    const elvis_real size = dot(CORE_GAUSS_WEIGHTS, abs(inside));
    const elvis_real per_size = elvis_real(1) / max(size, elvis_real(1e-30LF));
    const elvis_real differ = abs(gauss - simpson), ratio = elvis_real(8) * per_size * differ;
    const elvis_real cubic = per_size * ((end - begin) - CORE_GAUSS_PER_NODE * (inside.z - inside.x));
    const elvis_real by_chance = size * min(CORE_CUBIC_MARGIN * cubic * cubic, elvis_real(1));
    section.weighted = length * gauss;
    section.missed = length * max(min(elvis_real(0.5LF) * differ, size * ratio * sqrt(ratio)), by_chance);
    return section;
}

// The parameter at which a polynomial takes the value, within `error` of it. It lies between `from` and `to`, where the polynomial is on
// different sides of the value: below at `from` if it `rises`. By Newton's method, or by halves where that leads out. `bend`:
// core_power_bend.
elvis_real core_breakpoint_parameter(const core_polynomial powers, elvis_real value, elvis_real from, elvis_real to, bool rises, elvis_real bend,
                     elvis_real error) {
    elvis_real low = from, high = to, x = from;
    bool is_found = false;
    for (uint iteration = 0u; iteration < CORE_BREAKPOINT_ITERATIONS && !is_found; ++iteration) {
        const elvis_real f = core_power_value(powers, x) - value, slope = core_power_slope(powers, x);
        const bool is_before = rises ? f < elvis_real(0) : f > elvis_real(0), is_there = abs(f) <= error;
        low = is_before ? x : low;
        high = is_before ? high : x;
        const elvis_real step = -f / slope, next = x + step;
        const bool is_inside = next > low && next < high;
        is_found = is_there || (is_inside && bend * step * step <= error) || high - low <= elvis_real(4) * CORE_ROUNDOFF;
        x = is_there ? x : is_inside ? next : elvis_real(0.5LF) * (low + high);
        if (is_found) {
            break;
        }
    }
    return x;
}

#if CORE_HAS_JUMPS
// Half the width of the interval around t, where the polynomial takes the value, outside of which it differs from it by more than `error`.
elvis_real core_uncertain_width(const core_polynomial powers, elvis_real t, elvis_real value, elvis_real error) {
    elvis_real width = elvis_real(4) * CORE_ROUNDOFF;
    bool is_uncertain = true;
    while (is_uncertain) {
        const elvis_real before = core_power_value(powers, max(t - width, elvis_real(0))) - value;
        const elvis_real after = core_power_value(powers, min(t + width, elvis_real(1))) - value;
        is_uncertain = min(abs(before), abs(after)) <= error && width < elvis_real(0.5LF);
        width *= elvis_real(2);
        if (!is_uncertain) {
            break;
        }
    }
    return width;
}

// By how much density and light change at the breakpoint at the piece's upper or lower end.
elvis_real core_jump_at(const core_held_piece held, bool is_upper) {
    const core_transfer_piece beyond = core_fetch_piece(is_upper ? held.index + 1u : held.index - 1u);
    const elvis_real at = is_upper ? held.upper : held.lower;
    const elvis_vec3 colors = abs(core_color_at(core_piece_of(held), at) - core_color_at(beyond, at));
    const elvis_real here = core_density_at(core_piece_of(held), at), there = core_density_at(beyond, at);
    return abs(here - there) + max(here, there) * max(max(colors.x, colors.y), colors.z);
}
#endif

// The interval [from, to] of the step's parameter from which the next section is cut.
struct core_step_interval {
    elvis_real from, to;
    // Length of the section at most, so that quadrature is good enough.
    elvis_real limit;
    // Of the polynomial in the interval: values at both ends, and bounds.
    elvis_real first, last, least, greatest;
    bool is_monotone;
    // The values except `first` must be recomputed; the previous section ended at a breakpoint.
    bool is_new, has_crossed;
};

// Always of the whole polynomial, so that errors do not add up.
void core_restrict(const core_polynomial p, inout core_step_interval interval) {
    const core_polynomial restricted = core_after(core_before(p, interval.to), interval.from / interval.to);
    interval.last = restricted.c[CORE_FIT_DEGREE];
    interval.least = core_least(restricted);
    interval.greatest = core_most(restricted);
    interval.is_monotone = core_is_monotone(restricted);
}

// From interval.from on, in one piece of the transfer function.
struct core_section {
    // Where it ends, and the polynomial there; its length in the step's parameter, and along the ray.
    elvis_real until, end, width, ray_length;
    // The breakpoint towards which the polynomial goes; whether the section ends there.
    elvis_real next;
    bool rises, meets;
    // One piece holds all of the interval; the polynomial changes in it by no more than its error; it is halved no further; or any of
    // these, or monotone.
    bool is_whole, is_small, is_smallest, is_simple;
};

core_section core_next_section(const core_polynomial powers, const core_step_interval interval, const core_held_piece held,
                               elvis_real bend, elvis_real error, elvis_real length) {
    const elvis_real from = interval.from, first = interval.first, last = interval.last;
    core_section section;
    section.rises = last > first;
    section.is_whole = interval.least - error >= held.lower && interval.greatest + error < held.upper;
    section.is_smallest = min(interval.to - from, interval.limit) <= CORE_SMALLEST_INTERVAL;
    section.is_small = (interval.is_monotone ? abs(last - first) : interval.greatest - interval.least) <= elvis_real(2) * error ||
                       section.is_smallest;
    section.is_simple = section.is_whole || section.is_small || interval.is_monotone;
    section.next = section.rises ? held.upper : held.lower;
    section.meets = section.is_simple && !section.is_whole && (section.rises ? last >= section.next : last < section.next);
    section.until = interval.to;
    if (section.meets) {
        section.until = core_breakpoint_parameter(powers, section.next, from, interval.to, section.rises, bend, elvis_real(0.25LF) * error);
    }
    const bool is_limited = section.until - from > interval.limit;
    section.until = is_limited ? from + interval.limit : section.until;
    section.meets = section.meets && !is_limited;
    section.end = core_power_value(powers, section.until);
    section.width = section.until - from;
    section.ray_length = section.width * length;
    return section;
}

// What the field's error E does to light along a step. With the density r, the colour c, the transmittance T, and the light R from behind
// over T, a channel is off by
//
//     integral of T (c - R) r'(f) E + integral of T r c'(f) E.
//
// T (c - R) changes along the ray with the colour only. So with G the integral of r'(f) from the step's beginning, the first is
//
//     T (c - R) G E at the step's end - integral of G (T (c - R) E)'.
//
// In a peak that is narrow in the step G comes back to zero: what the error takes on one side, it gives on the other.
struct core_field_effect {
    // Bounds of all without regard to signs, and of all but what stands at the step's end in the other form.
    elvis_real unsigned_bound, signed_bound;
    // G.
    elvis_real swing;
    // What it does where the field may be on the other side of a breakpoint; and where it may be all beyond a jump, or not.
    elvis_real at_breakpoints, at_jumps;
};

// `before`: the transmittance up to the section; `length`: of the step.
void core_add_field_effect(inout core_field_effect effect, const core_step_interval interval, const core_section section,
                           const core_held_piece held, elvis_real before, elvis_real length, elvis_real error) {
    const elvis_real swing = effect.swing + section.width * held.density_slope;
    const elvis_real mean_swing = elvis_real(0.5LF) * (abs(effect.swing) + abs(swing));
    const elvis_real change = interval.is_monotone ? abs(section.end - interval.first) : interval.greatest - interval.least;
    const elvis_real of_color = held.steepness - abs(held.density_slope);
    effect.unsigned_bound += before * section.ray_length * error * held.steepness;
    effect.signed_bound += before * error * (section.ray_length * (CORE_ERROR_CHANGE * mean_swing + of_color) +
                                             length * mean_swing * core_color_slope(held) * change);
    effect.swing = swing;
}

// At least what it comes to in the end.
elvis_real core_least_effect(const core_field_effect effect) {
    return effect.at_breakpoints + effect.at_jumps + min(effect.unsigned_bound, effect.signed_bound);
}

// Of the whole step, into what light is off. `transmittance`: up to its end.
void core_add_effect(inout core_light light, const core_field_effect effect, const core_fitted fitted, elvis_real length) {
    const elvis_real at_end = light.transmittance * length * fitted.error * abs(effect.swing);
    const elvis_real all = effect.at_breakpoints + min(effect.unsigned_bound, effect.signed_bound + at_end);
    const elvis_real of_rounding = fitted.rounding / fitted.error * all;
    light.error += all - of_rounding + effect.at_jumps;
    light.rounding += of_rounding * of_rounding;
}

// Light of the section, if quadrature is good enough, which is returned. `missed`: the sum of what it is off; `allowed`: in this section;
// `of_field`: what the field's error does to it.
bool core_add_section(inout core_light light, const core_attenuation attenuation, const core_section section,
                      const core_held_piece held, elvis_real of_field, elvis_real allowed, inout elvis_real missed) {
    const elvis_real before = light.transmittance, miss = before * core_color_slope(held) * attenuation.missed;
    // Quadrature need not be better than the field.
    const bool is_good = miss <= max(allowed, elvis_real(0.25LF) * (miss + of_field)) || section.is_smallest;
    const bool is_done = section.is_simple && is_good;
    const elvis_real absorbed = is_done ? before * (elvis_real(1) - attenuation.transmittance) : elvis_real(0);
    const elvis_real weighted = is_done ? before * attenuation.weighted : elvis_real(0);
    light.red += absorbed * held.red + weighted * held.red_slope;
    light.green += absorbed * held.green + weighted * held.green_slope;
    light.blue += absorbed * held.blue + weighted * held.blue_slope;
    light.transmittance *= is_done ? attenuation.transmittance : elvis_real(1);
    light.error += is_done ? miss : elvis_real(0);
    missed += is_done ? miss : elvis_real(0);
    return is_done;
}

// How far from t the polynomial may stay as near to its value there as `reach`. `bend`: core_power_bend.
elvis_real core_stay(const core_polynomial powers, elvis_real t, elvis_real bend, elvis_real reach) {
    const elvis_real slope = abs(core_power_slope(powers, t)), rest = slope * slope - elvis_real(4) * bend * reach;
    return rest > elvis_real(0) ? elvis_real(2) * reach / (slope + sqrt(rest)) : CORE_FAR;
}

// Where the polynomial comes so near to a breakpoint that the field may be on the other side: there the density's slope is another one, by
// twice the steepest at most, for half of that way on average. `before`: the transmittance up to the section; `length`: of the step.
void core_add_breakpoint_effect(inout core_field_effect effect, const core_polynomial powers, const core_step_interval interval,
                                const core_section section, const core_held_piece held, elvis_real before, elvis_real length,
                                elvis_real bend, elvis_real error, bool is_done, bool crosses) {
    const elvis_real first = interval.first, end = section.end;
    const elvis_real reach = (section.is_small ? elvis_real(3) : elvis_real(1.25LF)) * error;
    const bool is_uncertain = is_done && !section.is_whole;
    const bool touches_first = is_uncertain && (section.rises ? first - held.lower : held.upper - first) <= reach;
    const bool touches_last = is_uncertain && !crosses && (section.rises ? held.upper - end : end - held.lower) <= reach;
    const elvis_real stay_first = touches_first ? core_stay(powers, interval.from, bend, reach) : elvis_real(0);
    const elvis_real stay_last = crosses || touches_last ? core_stay(powers, section.until, bend, reach) : elvis_real(0);
    effect.at_breakpoints += before * length * reach * elvis_real(core_steepest) *
                             (min(stay_first, section.width) + min(stay_last, section.width));
#if CORE_HAS_JUMPS
    if ((touches_first && !interval.has_crossed) || touches_last) {
        effect.at_jumps += before * section.ray_length * core_jump_at(held, touches_last == section.rises);
    }
    if (crosses) {
        const elvis_real width = core_uncertain_width(powers, section.until, section.next, error);
        effect.at_breakpoints += before * length * width * core_jump_at(held, section.rises);
    }
#endif
}

// On, in the interval or beyond it; or back to half of the interval, or of the section.
void core_choose_interval(const core_section section, bool is_done, bool crosses, inout core_step_interval interval) {
    const elvis_real step = interval.to - interval.from;
    const bool is_beyond = is_done && !crosses && section.until >= interval.to;
    interval.first = is_done ? section.end : interval.first;
    interval.from = is_done ? section.until : interval.from;
    interval.to = is_beyond           ? min(interval.to + elvis_real(2) * max(step, CORE_SMALLEST_INTERVAL), elvis_real(1))
                  : section.is_simple ? interval.to
                                      : interval.from + elvis_real(0.5LF) * step;
    interval.limit = is_done             ? min(elvis_real(2) * interval.limit, elvis_real(1))
                     : section.is_simple ? elvis_real(0.5LF) * section.width
                                         : interval.limit;
    interval.is_new = is_beyond || !section.is_simple;
    interval.has_crossed = is_done ? crosses : interval.has_crossed;
}

// All of a polynomial, over `length` of the ray; or less, if light is off by more than `most` before the end. `held`: the piece that holds
// the polynomial's beginning. `missed`: what quadrature is off, by no more than `allowed` in any section.
//
// Intervals in which the polynomial is monotone, or in one piece, or changes by no more than its error, are cut at breakpoints. Others are
// halved, and so are sections in which quadrature is not good enough.
void core_add_polynomial(inout core_light light, const core_fitted fitted, elvis_real length, elvis_real most, elvis_real allowed,
                         inout core_held_piece held, inout uint n_breakpoints, inout elvis_real missed, inout uint work) {
    const core_polynomial p = fitted.p;
    const elvis_real bend = core_power_bend(fitted.powers), error = fitted.error;
    const elvis_real of_fit = elvis_real(1) - fitted.rounding / error;
    core_step_interval interval = core_step_interval(elvis_real(0), elvis_real(1), elvis_real(1), p.c[0], p.c[CORE_FIT_DEGREE],
                                                     core_least(p), core_most(p), core_is_monotone(p), false, false);
    core_field_effect effect = core_field_effect(elvis_real(0), elvis_real(0), elvis_real(0), elvis_real(0), elvis_real(0));
    uint n_iterations = 0u;
    while (interval.from < elvis_real(1) && light.error + of_fit * core_least_effect(effect) <= most &&
           n_iterations < CORE_MOST_ITERATIONS) {
        n_iterations += 1u;
        work += CORE_WORK_AN_ITERATION;
        if (interval.is_new) {
            core_restrict(p, interval);
        }
        const core_section section = core_next_section(fitted.powers, interval, held, bend, error, length);
        const core_attenuation attenuation = core_attenuate(fitted.powers, held, interval.from, section.width,
                                                            interval.first - held.from, section.end - held.from, section.ray_length);
        const elvis_real before = light.transmittance;
        core_field_effect next = effect;
        core_add_field_effect(next, interval, section, held, before, length, error);
        const elvis_real of_field = core_least_effect(next) - core_least_effect(effect);
        const bool is_done = core_add_section(light, attenuation, section, held, of_field, allowed, missed);
        const bool crosses = is_done && section.meets;
        effect.unsigned_bound = is_done ? next.unsigned_bound : effect.unsigned_bound;
        effect.signed_bound = is_done ? next.signed_bound : effect.signed_bound;
        effect.swing = is_done ? next.swing : effect.swing;
        core_add_breakpoint_effect(effect, fitted.powers, interval, section, held, before, length, bend, error, is_done, crosses);
        if (crosses) {
            held = core_load_piece(section.rises ? held.index + 1u : held.index - 1u);
        }
        n_breakpoints += crosses ? 1u : 0u;
        core_choose_interval(section, is_done, crosses, interval);
        if (interval.from >= elvis_real(1) || light.error + of_fit * core_least_effect(effect) > most) {
            break;
        }
    }
    core_add_effect(light, effect, fitted, length);
    // Not all of it is there.
    const elvis_real lost = interval.from < elvis_real(1) ? elvis_real(1) : elvis_real(0);
    light.error += lost;
    missed += lost;
}
