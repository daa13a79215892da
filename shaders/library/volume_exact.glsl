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
#include "library/segment_crossings.glsl"

// Of what the kernel does in one dispatch: for a breakpoint, and for any step.
#define CORE_WORK_A_CROSSING 12u
#define CORE_WORK_A_STEP 3u
// Breakpoints met in one step, beyond which it is not to be good.
#define CORE_MOST_CROSSINGS 32u

struct core_rules {
    elvis_real kronrod, gauss, size;
};

// `i`: literal in every call, since arrays of constants are read from memory otherwise.
void core_add_node(core_polynomial q, core_transfer_piece piece, elvis_real length, int i, inout core_rules rules) {
    elvis_real value = elvis_real(0), integral = elvis_real(0);
    for (int j = 0; j < CORE_SEGMENT_SIZE; ++j) {
        value += core_quadrature_values[i][j] * q.c[j];
        integral += core_quadrature_integrals[i][j] * q.c[j];
    }
    const elvis_real depth = length * (piece.density * core_kronrod_at[i] + piece.density_slope * integral);
    const elvis_real weighted = value * (piece.density + piece.density_slope * value) * elvis_exp(-depth);
    rules.kronrod += core_kronrod_weights[i] * weighted;
    rules.gauss += core_gauss_weights[i] * weighted;
    rules.size += core_kronrod_weights[i] * abs(weighted);
}

// Integral of q dO, D = length (density s + slope integral of q), over a part of the ray; its error.
elvis_vec2 core_weighted_value(core_polynomial q, core_transfer_piece piece, elvis_real length) {
    core_rules rules = core_rules(elvis_real(0), elvis_real(0), elvis_real(0));
    core_add_node(q, piece, length, 0, rules);
    core_add_node(q, piece, length, 1, rules);
    core_add_node(q, piece, length, 2, rules);
    core_add_node(q, piece, length, 3, rules);
    core_add_node(q, piece, length, 4, rules);
    core_add_node(q, piece, length, 5, rules);
    core_add_node(q, piece, length, 6, rules);
    return length * elvis_vec2(rules.kronrod, core_kronrod_error(rules.kronrod, rules.gauss, rules.size));
}

elvis_real core_mean(core_polynomial q) {
    elvis_real sum = elvis_real(0);
    for (int i = 0; i < CORE_SEGMENT_SIZE; ++i) {
        sum += q.c[i];
    }
    return sum / elvis_real(CORE_SEGMENT_SIZE);
}

// A piece without breakpoints inside; `error`: of the field. `missed` grows by what quadrature is off.
void core_add_piece(inout core_light light, core_polynomial p, elvis_real length, elvis_real error, inout elvis_real missed) {
    const core_transfer_piece piece = core_fetch_piece(core_piece_index(core_bernstein_value(p, elvis_real(0.5LF))));
    core_polynomial q;
    for (int i = 0; i < CORE_SEGMENT_SIZE; ++i) {
        q.c[i] = p.c[i] - piece.from;
    }
    const elvis_real depth = max(length * (piece.density + piece.density_slope * core_mean(q)), elvis_real(0));
    const elvis_real through = elvis_exp(-depth);
    const elvis_real slope = max(max(abs(piece.color_slope.x), abs(piece.color_slope.y)), abs(piece.color_slope.z));
    elvis_vec2 weighted = elvis_vec2(0);
    for (uint turn = 0u; turn < (slope * depth > elvis_real(0) ? 1u : 0u); ++turn) {
        weighted = core_weighted_value(q, piece, length);
    }
    missed += light.left * slope * weighted.y;
    light.error += light.left * (slope * weighted.y + length * piece.steepness * error);
    core_add_light(light, (elvis_real(1) - through) * piece.color + weighted.x * piece.color_slope, through);
}

// Whether a polynomial that is off by `error` at most meets no breakpoint, as most do.
bool core_is_in_one_piece(core_polynomial p, elvis_real error) {
    return core_piece_index(core_least(p) - error) == core_piece_index(core_most(p) + error);
}

// How far from a crossing at t the polynomial is not off by more than `error` on both sides yet.
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

// All of a polynomial, on a part of a ray of this length, that is off by `error` at most. `is_whole`: it is in one piece.
void core_add_polynomial(inout core_light light, core_polynomial p, elvis_real length, elvis_real error, bool is_whole,
                         inout uint n_breakpoints, inout elvis_real missed, inout uint work) {
    for (uint turn = 0u; turn < (is_whole ? 1u : 0u); ++turn) {
        core_add_piece(light, p, length, error, missed);
    }
    core_walk walk = core_walk_begin();
    elvis_real from = elvis_real(0);
    uint n_pieces = 0u;
    bool is_over = is_whole;
    while (!is_over) {
        const core_crossing crossing = core_next_crossing(p, error, core_n_breakpoints, walk);
        n_pieces += 1u;
        work += CORE_WORK_A_CROSSING;
        is_over = crossing.kind == CORE_CROSSING_NONE || n_pieces > CORE_MOST_CROSSINGS;
        const elvis_real to = is_over ? elvis_real(1) : clamp(crossing.t, from, elvis_real(1));
        n_breakpoints += is_over ? 0u : 1u;
        for (uint turn = 0u; turn < (to > from ? 1u : 0u); ++turn) {
            const core_polynomial cell = core_after(core_before(p, to), from / to);
            core_add_piece(light, cell, (to - from) * length, error, missed);
        }
        // Where the polynomial cannot tell on which side of the breakpoint the field is, and steps, which are where it crosses.
        for (uint turn = 0u; turn < (!is_over && (core_has_steps != 0u || crossing.kind == CORE_CROSSING_TOUCH) ? 1u : 0u); ++turn) {
            const core_transfer_piece below = core_fetch_piece(crossing.index), above = core_fetch_piece(crossing.index + 1u);
            const elvis_real width = crossing.upper - crossing.lower;
            const elvis_real at = core_level_value(crossing.index);
            const elvis_vec3 colors = abs(core_color_at(below, at) - core_color_at(above, at));
            const elvis_real densities = abs(core_density_at(below, at) - core_density_at(above, at));
            const elvis_real jump = densities + core_density_at(above, at) * max(max(colors.x, colors.y), colors.z);
            const bool is_touch = crossing.kind == CORE_CROSSING_TOUCH;
            const elvis_real share = is_touch ? width : core_doubtful_width(p, crossing.t, at, error);
            const elvis_real bends = is_touch ? elvis_real(2) * error * abs(above.steepness - below.steepness) : elvis_real(0);
            light.error += light.left * length * share * (jump + bends);
        }
        from = to;
    }
    light.error += n_pieces > CORE_MOST_CROSSINGS ? elvis_real(1) : elvis_real(0);
}
