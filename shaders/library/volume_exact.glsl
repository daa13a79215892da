// The volume rendering integral of a polynomial: cut at the breakpoints of the transfer function, so that between them density and
// colour are polynomials; the inner integral is then that of a polynomial, exactly. With the absorbed share O = 1 - exp(-D) the outer one
// is
//     integral of (c + c' (p - from)) dO  =  c O + c' integral of (p - from) dO,
//
// which is exact where the colour is constant; else one number is left to quadrature, whatever the number of channels.
//
// The kernel brings library/volume_light.glsl and the tables of degree 5 (core/segment/tables.hpp).

#include "library/kronrod.glsl"
#include "library/segment_bernstein.glsl"

// Of what the kernel does in one dispatch.
#define CORE_WORK_A_STEP 3u
#define CORE_WORK_A_TURN 6u
// Breakpoints met and cells halved in one step, beyond which it is not to be good.
#define CORE_MOST_TURNS 256u
#define CORE_MEETING_TURNS 48u
// Of the parameter: cells are not halved further.
#define CORE_SMALLEST_CELL elvis_real(1.52587890625e-5LF)
// Of what a step may be off, what quadrature may be in a cell: little, as its estimate may be far too small where both rules happen to
// agree (with 1/32, spheres of peaks at tolerance 1e-8 were off by up to 7e-8 in one pixel of 50000).
#define CORE_QUADRATURE_SHARE elvis_real(0.001953125LF)

// Of q dO / dt over length. `i`: literal in every call, since arrays of constants are read from memory otherwise.
elvis_real core_weighted_at(core_polynomial q, core_transfer_piece piece, elvis_real length, int i) {
    elvis_real value = elvis_real(0), integral = elvis_real(0);
    for (int j = 0; j < CORE_SEGMENT_SIZE; ++j) {
        value += core_quadrature_values[i][j] * q.c[j];
        integral += core_quadrature_integrals[i][j] * q.c[j];
    }
    const elvis_real depth = length * (piece.density * core_kronrod_at[i] + piece.density_slope * integral);
    return value * (piece.density + piece.density_slope * value) * elvis_exp(-depth);
}

// Integral of q dO, D = length (density s + slope integral of q), over a part of the ray, by Gauss' rule; its error. `through`: exp(-D) at
// the end.
//
// The error is estimated from Simpson's rule, which needs but the ends besides. With h the part's length Simpson's error is about
// h^5 / 2880 times the fourth derivative, Gauss' h^7 / 2016000 times the sixth: for exp(h) that is 0.08 of the 3/2th power of the other,
// of which a few hundred times as much are taken.
elvis_vec2 core_weighted_value(core_polynomial q, core_transfer_piece piece, elvis_real length, elvis_real through) {
    const elvis_real first = core_weighted_at(q, piece, length, 1), middle = core_weighted_at(q, piece, length, 3);
    const elvis_real last = core_weighted_at(q, piece, length, 5);
    const elvis_real begin = q.c[0] * (piece.density + piece.density_slope * q.c[0]);
    const elvis_real end = q.c[CORE_SEGMENT_DEGREE] * (piece.density + piece.density_slope * q.c[CORE_SEGMENT_DEGREE]) * through;
    const elvis_real gauss = core_gauss_weights[1] * (first + last) + core_gauss_weights[3] * middle;
    const elvis_real simpson = (begin + elvis_real(4) * middle + end) * elvis_real(0.16666666666666666667LF);
    const elvis_real size = core_gauss_weights[1] * (abs(first) + abs(last)) + core_gauss_weights[3] * abs(middle);
    const elvis_real differ = abs(gauss - simpson), ratio = elvis_real(8) * differ / max(size, elvis_real(1e-30LF));
    return length * elvis_vec2(gauss, min(elvis_real(0.5LF) * differ, size * ratio * sqrt(ratio)));
}

elvis_real core_mean(core_polynomial q) {
    elvis_real sum = elvis_real(0);
    for (int i = 0; i < CORE_SEGMENT_SIZE; ++i) {
        sum += q.c[i];
    }
    return sum / elvis_real(CORE_SEGMENT_SIZE);
}

// A piece without breakpoints inside; `error`: of the field. What quadrature is off.
elvis_real core_add_piece(inout core_light light, core_polynomial p, core_transfer_piece piece, elvis_real length, elvis_real error) {
    core_polynomial q;
    for (int i = 0; i < CORE_SEGMENT_SIZE; ++i) {
        q.c[i] = p.c[i] - piece.from;
    }
    const elvis_real depth = max(length * (piece.density + piece.density_slope * core_mean(q)), elvis_real(0));
    const elvis_real through = elvis_exp(-depth);
    const elvis_real slope = max(max(abs(piece.color_slope.x), abs(piece.color_slope.y)), abs(piece.color_slope.z));
    const elvis_vec2 weighted = core_weighted_value(q, piece, length, through);
    const elvis_real missed = light.left * slope * weighted.y;
    light.error += missed + light.left * length * piece.steepness * error;
    core_add_light(light, (elvis_real(1) - through) * piece.color + weighted.x * piece.color_slope, through);
    return missed;
}

// Where a polynomial that is on both sides of the value at the ends of [0, 1], or on it at the second, comes to it, within `error` of the
// value.
elvis_real core_meet(core_polynomial p, elvis_real value, elvis_real error) {
    elvis_real a = elvis_real(0), b = elvis_real(1), fa = p.c[0] - value, fb = p.c[CORE_SEGMENT_DEGREE] - value;
    elvis_real x = abs(fa) <= error ? a : b, fx = abs(fa) <= error ? fa : fb;
    for (uint turn = 0u; turn < CORE_MEETING_TURNS && abs(fx) > error && b - a > elvis_real(4) * CORE_ROUNDOFF; ++turn) {
        x = a + (b - a) * (fa / (fa - fb));
        fx = core_bernstein_value(p, x) - value;
        const bool is_first = (fx < elvis_real(0)) == (fb < elvis_real(0));
        // An end that stays counts half from then on, so that it does not for long (the Illinois rule).
        fa = is_first ? elvis_real(0.5LF) * fa : fx;
        fb = is_first ? fx : elvis_real(0.5LF) * fb;
        a = is_first ? a : x;
        b = is_first ? x : b;
    }
    return x;
}

#if CORE_HAS_STEPS
// How far from where it meets the value, at t, the polynomial is not off by more than `error` on both sides yet.
elvis_real core_doubtful_width(core_polynomial p, elvis_real t, elvis_real value, elvis_real error) {
    elvis_real width = elvis_real(4) * CORE_ROUNDOFF;
    bool is_doubtful = true;
    while (is_doubtful) {
        const elvis_real before = core_bernstein_value(p, max(t - width, elvis_real(0))) - value;
        const elvis_real after = core_bernstein_value(p, min(t + width, elvis_real(1))) - value;
        is_doubtful = min(abs(before), abs(after)) <= error && width < elvis_real(0.5LF);
        width *= elvis_real(2);
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
// `held`: the piece that holds its beginning. `missed`: what quadrature is off, not more than `allowed` in any cell.
//
// Cells in which it is monotone, or in one piece, or that do not change by more than it is off anyway, are gone through from breakpoint to
// breakpoint; others are halved, and where quadrature is not good enough. Cells are always those of the whole polynomial, so that errors
// do not add up.
void core_add_polynomial(inout core_light light, core_polynomial p, elvis_real length, elvis_real error, elvis_real most, elvis_real allowed,
                         inout core_held_piece held, inout uint n_breakpoints, inout elvis_real missed, inout uint work) {
    elvis_real from = elvis_real(0), to = elvis_real(1);
    bool has_crossed = false;
    uint n_turns = 0u;
    while (from < elvis_real(1) && light.error <= most && n_turns < CORE_MOST_TURNS) {
        n_turns += 1u;
        work += CORE_WORK_A_TURN;
        const core_polynomial cell = core_after(core_before(p, to), from / to);
        const elvis_real first = cell.c[0], last = cell.c[CORE_SEGMENT_DEGREE], least = core_least(cell), size = core_most(cell) - least;
        const bool rises = last > first;
        const bool is_whole = least - error >= held.lower && (least + size) + error < held.upper;
        const bool is_smallest = to - from <= CORE_SMALLEST_CELL, is_small = size <= elvis_real(2) * error || is_smallest;
        const bool is_simple = is_whole || is_small || core_is_monotone(cell);
        const elvis_real next = rises ? held.upper : held.lower;
        const bool meets = is_simple && !is_whole && (rises ? last >= next : last < next);
        elvis_real share = elvis_real(1);
        for (uint turn = 0u; turn < (meets ? 1u : 0u); ++turn) {
            share = core_meet(cell, next, elvis_real(0.25LF) * error);
        }
        const elvis_real left = light.left;
        core_light with = light;
        const elvis_real miss = core_add_piece(with, core_before(cell, share), core_piece_of(held), share * (to - from) * length, error);
        // Quadrature need not be better than the field.
        const bool is_good = miss <= max(allowed, elvis_real(0.25LF) * (with.error - light.error)) || is_smallest;
        const bool is_done = is_simple && is_good, crosses = is_done && meets;
        light.red = is_done ? with.red : light.red;
        light.green = is_done ? with.green : light.green;
        light.blue = is_done ? with.blue : light.blue;
        light.left = is_done ? with.left : light.left;
        light.error = is_done ? with.error : light.error;
        missed += is_done ? miss : elvis_real(0);

        // Where it comes so near to a breakpoint the field may be on the other side: near turns and ends for as long as it likes, else on its way
        // across.
        const elvis_real reach = (is_small ? elvis_real(3) : elvis_real(1.25LF)) * error, length_done = share * (to - from) * length;
        const elvis_real across = min(elvis_real(4) * reach / max(abs((meets ? next : last) - first), reach), elvis_real(1));
        const bool is_doubtful = is_done && !is_whole;
        const bool touches_first = is_doubtful && (rises ? first - held.lower : held.upper - first) <= reach;
        const bool touches_last = is_doubtful && !meets && (rises ? held.upper - last : last - held.lower) <= reach;
        const elvis_real first_share = touches_first ? (has_crossed ? across : elvis_real(1)) : elvis_real(0);
        const elvis_real last_share = crosses ? across : touches_last ? elvis_real(1) : elvis_real(0);
        light.error += left * length_done * (reach + error) * elvis_real(core_steepest) * (first_share + last_share);
#if CORE_HAS_STEPS
        for (uint turn = 0u; turn < ((touches_first && !has_crossed) || touches_last ? 1u : 0u); ++turn) {
            light.error += left * length_done * core_jump_at(held, touches_last == rises);
        }
        for (uint turn = 0u; turn < (crosses ? 1u : 0u); ++turn) {
            light.error += left * (to - from) * length * core_doubtful_width(cell, share, next, error) * core_jump_at(held, rises);
        }
#endif
        for (uint turn = 0u; turn < (crosses ? 1u : 0u); ++turn) {
            held = core_hold_piece(rises ? held.index + 1u : held.index - 1u);
        }
        n_breakpoints += crosses ? 1u : 0u;
        has_crossed = is_done ? crosses : has_crossed;
        const elvis_real step = to - from, reached = from + share * step;
        from = crosses ? min(reached, to) : is_done ? to : from;
        to = crosses ? to : is_done ? min(to + elvis_real(2) * max(step, CORE_SMALLEST_CELL), elvis_real(1)) : from + elvis_real(0.5LF) * share * step;
    }
    // Not all of it is there.
    const elvis_real lost = from < elvis_real(1) ? elvis_real(1) : elvis_real(0);
    light.error += lost;
    missed += lost;
}
