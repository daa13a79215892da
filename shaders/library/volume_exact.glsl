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

// Parts of a piece for quadrature, at first one for each of these optical depths; at most.
#define CORE_DEPTH_A_PART elvis_real(2)
#define CORE_MOST_QUADRATURE_PARTS 16u
// Breakpoints met in one step, beyond which it is not to be good.
#define CORE_MOST_CROSSINGS 32u

// Integral over s from 0 to 1 of p - from.
elvis_real core_mean_above(core_polynomial p, elvis_real from) {
    elvis_real sum = elvis_real(0);
    for (int i = 0; i < CORE_SEGMENT_SIZE; ++i) {
        sum += p.c[i] - from;
    }
    return sum / elvis_real(CORE_SEGMENT_SIZE);
}

// Integral over s from 0 to t of p - from: in the Bernstein form of one degree more, whose coefficients are sums of those of p.
elvis_real core_integral_above(core_polynomial p, elvis_real from, elvis_real t) {
    const elvis_real s = elvis_real(1) - t;
    elvis_real power = elvis_real(1), sum = elvis_real(0), coefficient = elvis_real(0), binomial = elvis_real(1);
    for (int i = 0; i < CORE_SEGMENT_SIZE; ++i) {
        coefficient += (p.c[i] - from) / elvis_real(CORE_SEGMENT_SIZE);
        power *= t;
        binomial = binomial * elvis_real(CORE_SEGMENT_SIZE - i) / elvis_real(i + 1);
        sum = sum * s + binomial * power * coefficient;
    }
    return sum;
}

// Integral of (p - from) dO, D = length (density s + slope integral of (p - from)); its error.
elvis_vec2 core_weighted_value(core_polynomial p, core_transfer_piece piece, elvis_real length, uint n_parts) {
    elvis_real kronrod_sum = elvis_real(0), error_sum = elvis_real(0);
    const elvis_real width = elvis_real(1) / elvis_real(n_parts);
    for (uint part = 0u; part < n_parts; ++part) {
        elvis_real kronrod = elvis_real(0), gauss = elvis_real(0), size = elvis_real(0);
        for (int i = 0; i < CORE_KRONROD_POINTS; ++i) {
            const elvis_real s = (elvis_real(part) + core_kronrod_at[i]) * width;
            const elvis_real above = core_bernstein_value(p, s) - piece.from;
            const elvis_real density = piece.density + piece.density_slope * above;
            const elvis_real depth = length * (piece.density * s + piece.density_slope * core_integral_above(p, piece.from, s));
            const elvis_real value = above * density * elvis_exp(-depth);
            kronrod += core_kronrod_weights[i] * value;
            gauss += core_gauss_weights[i] * value;
            size += core_kronrod_weights[i] * abs(value);
        }
        kronrod_sum += kronrod;
        error_sum += core_kronrod_error(kronrod, gauss, size);
    }
    return length * width * elvis_vec2(kronrod_sum, error_sum);
}

// A piece without breakpoints inside; `error`: of the field. `work` grows by what loops have done.
void core_add_piece(inout core_light light, core_polynomial p, elvis_real length, elvis_real error, elvis_real allowed, inout uint work) {
    const core_transfer_piece piece = core_fetch_piece(core_piece_index(core_bernstein_value(p, elvis_real(0.5LF))));
    const elvis_real depth =
        max(length * (piece.density + piece.density_slope * core_mean_above(p, piece.from)), elvis_real(0));
    const elvis_real through = elvis_exp(-depth);
    const elvis_real slope = max(max(abs(piece.color_slope.x), abs(piece.color_slope.y)), abs(piece.color_slope.z));
    elvis_vec2 weighted = elvis_vec2(0);
    uint n_parts = slope * depth > elvis_real(0) ? uint(min(depth / CORE_DEPTH_A_PART, elvis_real(CORE_MOST_QUADRATURE_PARTS - 1u))) + 1u : 0u;
    while (n_parts > 0u) {
        weighted = core_weighted_value(p, piece, length, n_parts);
        work += n_parts;
        const bool is_good = light.left * slope * weighted.y <= allowed || n_parts >= CORE_MOST_QUADRATURE_PARTS;
        n_parts = is_good ? 0u : 2u * n_parts;
    }
    light.error += light.left * (slope * weighted.y + length * piece.steepness * error);
    core_add_light(light, (elvis_real(1) - through) * piece.color + weighted.x * piece.color_slope, through);
}

// All of a polynomial, on a part of a ray of this length, that is off by `error` at most.
void core_add_polynomial(inout core_light light, core_polynomial p, elvis_real length, elvis_real error, elvis_real allowed,
                         inout uint n_breakpoints, inout uint work) {
    core_walk walk = core_walk_begin();
    elvis_real from = elvis_real(0);
    uint n_pieces = 0u;
    bool is_over = false;
    while (!is_over) {
        const core_crossing crossing = core_next_crossing(p, error, core_n_breakpoints, walk);
        n_pieces += 1u;
        work += 2u;
        is_over = crossing.kind == CORE_CROSSING_NONE || n_pieces > CORE_MOST_CROSSINGS;
        const elvis_real to = is_over ? elvis_real(1) : clamp(crossing.t, from, elvis_real(1));
        n_breakpoints += is_over ? 0u : 1u;
        for (uint turn = 0u; turn < (to > from ? 1u : 0u); ++turn) {
            const core_polynomial cell = core_after(core_before(p, to), from / to);
            core_add_piece(light, cell, (to - from) * length, error, allowed, work);
        }
        // Where the polynomial cannot tell on which side of the breakpoint the field is, and steps, which are where it crosses.
        for (uint turn = 0u; turn < (is_over ? 0u : 1u); ++turn) {
            const core_transfer_piece below = core_fetch_piece(crossing.index), above = core_fetch_piece(crossing.index + 1u);
            const elvis_real width = crossing.upper - crossing.lower;
            const elvis_real rise = abs(core_bernstein_value(p, crossing.upper) - core_bernstein_value(p, crossing.lower));
            const elvis_real at = core_level_value(crossing.index);
            const elvis_vec3 colors = abs(core_color_at(below, at) - core_color_at(above, at));
            const elvis_real densities = abs(core_density_at(below, at) - core_density_at(above, at));
            const elvis_real jump = densities + core_density_at(above, at) * max(max(colors.x, colors.y), colors.z);
            const bool is_touch = crossing.kind == CORE_CROSSING_TOUCH;
            const elvis_real share = is_touch ? width : min(error * width / max(rise, elvis_real(1e-30LF)), width);
            const elvis_real bends = is_touch ? elvis_real(2) * error * abs(above.steepness - below.steepness) : elvis_real(0);
            light.error += light.left * length * share * (jump + bends);
        }
        from = to;
    }
    light.error += n_pieces > CORE_MOST_CROSSINGS ? elvis_real(1) : elvis_real(0);
}
