// The volume rendering integral of a polynomial: cut at the breakpoints of the transfer function, so that between them density and
// colour are polynomials; the inner integral is then that of a polynomial, exactly. With the absorbed share O = 1 - exp(-D) the outer one
// is
//     integral of (c + c' (p - from)) dO  =  c O + c' integral of (p - from) dO,
//
// which is exact where the colour is constant; else one number is left to quadrature, whatever the number of channels.
//
// The kernel brings volume/volume_light.glsl and the tables of degree 5 (core/segment/tables.hpp).

#include "segments/bernstein.glsl"

// Of what the kernel does in one dispatch.
#define CORE_WORK_A_STEP 3u
#define CORE_WORK_AN_ITERATION 6u
// Breakpoints met and cells halved in one step, beyond which it is not to be good.
#define CORE_MOST_ITERATIONS 256u
#define CORE_MEETING_ITERATIONS 48u
// Of the parameter: cells are not halved further.
#define CORE_SMALLEST_CELL elvis_real(1.52587890625e-5LF)
// Of what a step may be off, what quadrature may be in a cell: little, as its estimate may be far too small where both rules happen to
// agree (with 1/32, spheres of peaks at tolerance 1e-8 were off by up to 7e-8 in one pixel of 50000).
#define CORE_QUADRATURE_SHARE elvis_real(0.001953125LF)

// Gauss' rule with three points on [0, 1], and the integrals up to these of the parabola through the values there: with these as depths
// the outer integral is of order 6 as well (the coefficients are those of Gauss' method for differential equations; E. Hairer, S. P.
// Norsett, G. Wanner, Solving Ordinary Differential Equations I, table II.7.4).
#define CORE_GAUSS_AT elvis_vec3(0.11270166537925831148LF, 0.5LF, 0.88729833462074168852LF)
#define CORE_GAUSS_WEIGHTS elvis_vec3(0.27777777777777777778LF, 0.44444444444444444444LF, 0.27777777777777777778LF)
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
elvis_real core_power_value(core_polynomial powers, elvis_real t) {
    elvis_real sum = powers.c[CORE_FIT_DEGREE];
    for (int i = 1; i < CORE_FIT_SIZE; ++i) {
        sum = sum * t + powers.c[CORE_FIT_DEGREE - i];
    }
    return sum;
}

elvis_real core_power_slope(core_polynomial powers, elvis_real t) {
    elvis_real sum = elvis_real(0);
    for (int i = 0; i < CORE_FIT_DEGREE; ++i) {
        sum = sum * t + elvis_real(CORE_FIT_DEGREE - i) * powers.c[CORE_FIT_DEGREE - i];
    }
    return sum;
}

// Half of what its slope changes by, at most, over [0, 1].
elvis_real core_power_bend(core_polynomial powers) {
    elvis_real sum = elvis_real(0);
    for (int i = 2; i < CORE_FIT_SIZE; ++i) {
        sum += elvis_real((i * (i - 1)) / 2) * abs(powers.c[i]);
    }
    return sum;
}

// A part of a step in one piece of the transfer function.
struct core_attenuation {
    // exp(-D), D the depth of all of it; the integral of (p - from) dO, and what that is off.
    elvis_real through, weighted, missed;
};

// From `first` to `last`, which are values less the piece's `from`, over `length` of the ray, by Gauss' rule.
//
// The error is estimated from Simpson's rule, which needs but the ends besides. With h the part's length Simpson's error is about
// h^5 / 2880 times the fourth derivative, Gauss' h^7 / 2016000 times the sixth: for exp(h) that is 0.08 of the 3/2th power of the other,
// of which a few hundred times as much are taken.
core_attenuation core_attenuate(core_polynomial powers, core_held_piece held, elvis_real from, elvis_real width, elvis_real first,
                               elvis_real last, elvis_real length) {
    const elvis_vec3 at = from + width * CORE_GAUSS_AT;
    const elvis_vec3 q = elvis_vec3(core_power_value(powers, at.x), core_power_value(powers, at.y), core_power_value(powers, at.z)) -
                         held.from;
    const elvis_vec3 density = held.density + held.density_slope * q;
    const elvis_vec3 through = elvis_vec3(core_transmittance(max(length * dot(CORE_GAUSS_TO_FIRST, density), elvis_real(0))),
                                          core_transmittance(max(length * dot(CORE_GAUSS_TO_MIDDLE, density), elvis_real(0))),
                                          core_transmittance(max(length * dot(CORE_GAUSS_TO_LAST, density), elvis_real(0))));
    core_attenuation part;
    part.through = core_transmittance(max(length * dot(CORE_GAUSS_WEIGHTS, density), elvis_real(0)));
    const elvis_vec3 inside = q * density * through;
    const elvis_real begin = first * (held.density + held.density_slope * first);
    const elvis_real end = last * (held.density + held.density_slope * last) * part.through;
    const elvis_real gauss = dot(CORE_GAUSS_WEIGHTS, inside);
    const elvis_real simpson = (begin + elvis_real(4) * inside.y + end) * elvis_real(0.16666666666666666667LF);
    const elvis_real size = dot(CORE_GAUSS_WEIGHTS, abs(inside));
    const elvis_real differ = abs(gauss - simpson), ratio = elvis_real(8) * differ / max(size, elvis_real(1e-30LF));
    part.weighted = length * gauss;
    part.missed = length * min(elvis_real(0.5LF) * differ, size * ratio * sqrt(ratio));
    return part;
}

// Where a polynomial comes to the value, within `error` of it, between points on both sides of it, the first below if it `rises`; by Newton's
// method, or by halves where that leads out. `bend`: core_power_bend.
elvis_real core_meet(core_polynomial powers, elvis_real value, elvis_real from, elvis_real to, bool rises, elvis_real bend,
                     elvis_real error) {
    elvis_real low = from, high = to, x = from;
    bool is_found = false;
    for (uint turn = 0u; turn < CORE_MEETING_ITERATIONS && !is_found; ++turn) {
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

#if CORE_HAS_STEPS
// How far from where it meets the value, at t, the polynomial is not off by more than `error` on both sides yet.
elvis_real core_uncertain_width(core_polynomial powers, elvis_real t, elvis_real value, elvis_real error) {
    elvis_real width = elvis_real(4) * CORE_ROUNDOFF;
    bool is_doubtful = true;
    while (is_doubtful) {
        const elvis_real before = core_power_value(powers, max(t - width, elvis_real(0))) - value;
        const elvis_real after = core_power_value(powers, min(t + width, elvis_real(1))) - value;
        is_doubtful = min(abs(before), abs(after)) <= error && width < elvis_real(0.5LF);
        width *= elvis_real(2);
        if (!is_doubtful) {
            break;
        }
    }
    return width;
}

// By how much density and light change at the breakpoint that the piece begins or ends with.
elvis_real core_jump_at(core_held_piece held, bool is_upper) {
    const core_transfer_piece beyond = core_fetch_piece(is_upper ? held.index + 1u : held.index - 1u);
    const elvis_real at = is_upper ? held.upper : held.lower;
    const elvis_vec3 colors = abs(core_color_at(core_piece_of(held), at) - core_color_at(beyond, at));
    const elvis_real here = core_density_at(core_piece_of(held), at), there = core_density_at(beyond, at);
    return abs(here - there) + max(here, there) * max(max(colors.x, colors.y), colors.z);
}
#endif

// All of a polynomial, on a part of a ray of this length, that is off by `error` at most; less if light is off by more than `most` before the end.
// `powers`: the same polynomial by powers of its parameter. `held`: the piece that holds its beginning. `missed`: what quadrature is off, not
// more than `allowed` in any part.
//
// Cells in which it is monotone, or in one piece, or that do not change by more than it is off anyway, are gone through from breakpoint to
// breakpoint; others are halved, and so are parts where quadrature is not good enough. Cells are always those of the whole polynomial, so
// that errors do not add up.
void core_add_polynomial(inout core_light light, core_polynomial p, core_polynomial powers, elvis_real length, elvis_real error,
                         elvis_real most, elvis_real allowed, inout core_held_piece held, inout uint n_breakpoints,
                         inout elvis_real missed, inout uint work) {
    const elvis_real bend = core_power_bend(powers);
    elvis_real from = elvis_real(0), to = elvis_real(1), limit = elvis_real(1);
    // Values at both ends of what is left of the cell; the cell's bounds.
    elvis_real first = p.c[0], last = p.c[CORE_FIT_DEGREE], least = core_least(p), greatest = core_most(p);
    bool is_monotone = core_is_monotone(p), is_new = false, has_crossed = false;
    uint n_turns = 0u;
    while (from < elvis_real(1) && light.error <= most && n_turns < CORE_MOST_ITERATIONS) {
        n_turns += 1u;
        work += CORE_WORK_AN_ITERATION;
        if (is_new) {
            const core_polynomial restricted = core_after(core_before(p, to), from / to);
            last = restricted.c[CORE_FIT_DEGREE];
            least = core_least(restricted);
            greatest = core_most(restricted);
            is_monotone = core_is_monotone(restricted);
        }
        const bool rises = last > first;
        const bool is_whole = least - error >= held.lower && greatest + error < held.upper;
        const bool is_smallest = min(to - from, limit) <= CORE_SMALLEST_CELL;
        const bool is_small = (is_monotone ? abs(last - first) : greatest - least) <= elvis_real(2) * error || is_smallest;
        const bool is_simple = is_whole || is_small || is_monotone;
        const elvis_real next = rises ? held.upper : held.lower;
        const bool meets = is_simple && !is_whole && (rises ? last >= next : last < next);
        elvis_real until = to;
        if (meets) {
            until = core_meet(powers, next, from, to, rises, bend, elvis_real(0.25LF) * error);
        }
        const bool is_limited = until - from > limit;
        until = is_limited ? from + limit : until;
        const elvis_real width = until - from, end = core_power_value(powers, until), part_length = width * length;
        const core_attenuation part =
            core_attenuate(powers, held, from, width, first - held.from, end - held.from, part_length);
        const elvis_real color_slope = max(max(abs(held.red_slope), abs(held.green_slope)), abs(held.blue_slope));
        const elvis_real left = light.left, miss = left * color_slope * part.missed;
        const elvis_real of_field = left * part_length * held.steepness * error;
        // Quadrature need not be better than the field.
        const bool is_good = miss <= max(allowed, elvis_real(0.25LF) * (miss + of_field)) || is_smallest;
        const bool is_done = is_simple && is_good, crosses = is_done && meets && !is_limited;
        const elvis_real absorbed = is_done ? left * (elvis_real(1) - part.through) : elvis_real(0);
        const elvis_real weighted = is_done ? left * part.weighted : elvis_real(0);
        light.red += absorbed * held.red + weighted * held.red_slope;
        light.green += absorbed * held.green + weighted * held.green_slope;
        light.blue += absorbed * held.blue + weighted * held.blue_slope;
        light.left *= is_done ? part.through : elvis_real(1);
        light.error += is_done ? miss + of_field : elvis_real(0);
        missed += is_done ? miss : elvis_real(0);

        // Where it comes so near to a breakpoint the field may be on the other side: near turns and ends for as long as it likes, else on its way
        // across.
        const elvis_real reach = (is_small ? elvis_real(3) : elvis_real(1.25LF)) * error;
        const elvis_real across = min(elvis_real(4) * reach / max(abs((crosses ? next : end) - first), reach), elvis_real(1));
        const bool is_doubtful = is_done && !is_whole;
        const bool touches_first = is_doubtful && (rises ? first - held.lower : held.upper - first) <= reach;
        const bool touches_last = is_doubtful && !crosses && (rises ? held.upper - end : end - held.lower) <= reach;
        const elvis_real first_share = touches_first ? (has_crossed ? across : elvis_real(1)) : elvis_real(0);
        const elvis_real last_share = crosses ? across : touches_last ? elvis_real(1) : elvis_real(0);
        light.error += left * part_length * (reach + error) * elvis_real(core_steepest) * (first_share + last_share);
#if CORE_HAS_STEPS
        if ((touches_first && !has_crossed) || touches_last) {
            light.error += left * part_length * core_jump_at(held, touches_last == rises);
        }
        if (crosses) {
            light.error += left * length * core_uncertain_width(powers, until, next, error) * core_jump_at(held, rises);
        }
#endif
        if (crosses) {
            held = core_hold_piece(rises ? held.index + 1u : held.index - 1u);
        }
        n_breakpoints += crosses ? 1u : 0u;
        has_crossed = is_done ? crosses : has_crossed;
        // On, in the cell or beyond it; or back to half of the cell, or of the part.
        const elvis_real step = to - from;
        const bool is_beyond = is_done && !crosses && until >= to;
        first = is_done ? end : first;
        from = is_done ? until : from;
        to = is_beyond   ? min(to + elvis_real(2) * max(step, CORE_SMALLEST_CELL), elvis_real(1))
             : is_simple ? to
                         : from + elvis_real(0.5LF) * step;
        limit = is_done ? min(elvis_real(2) * limit, elvis_real(1)) : is_simple ? elvis_real(0.5LF) * width : limit;
        is_new = is_beyond || !is_simple;
        if (from >= elvis_real(1) || light.error > most) {
            break;
        }
    }
    // Not all of it is there.
    const elvis_real lost = from < elvis_real(1) ? elvis_real(1) : elvis_real(0);
    light.error += lost;
    missed += lost;
}
