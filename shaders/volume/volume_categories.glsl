// The volume rendering integral along a segment, by what the field's range there leaves of the transfer function
// (B. Nelson, 2012, algorithm 2 and section 6.4): its density and its colour are each empty (zero), smooth (no breakpoint in the
// range) or piecewise smooth.
//
//     density        colour               the inner integral, of density        the outer one, of light
//     empty          any                  none: passed over
//     smooth         empty                Gauss and Kronrod                     none
//     piecewise      empty                trapezoidal rule                      none
//     smooth         smooth               trapezoidal rule, between the points  Gauss and Kronrod
//     else                                trapezoidal rule                      trapezoidal rule
//
// The range is bounded from the field's values and slopes at both ends and how far it may be from those lines (segments/ray_sample.glsl);
// often the last end alone tells that there is nothing. That deviation goes with the square of the distance r from the point x that
// was evaluated. With the sample at a distance e from x, what is in its half of the segment of length 1 has (1/2 + e)^2 of it at most,
// which is less than 3/8 + 3 e^2 for every e; and the sample's error has e^2 of it.
//
// The segment has panels of equal length: of one step for the trapezoidal rule, else of the points of Kronrod's rule and the
// panel's end, or of fewer where core_step_length does not ask for as many. All go by the same sum: with s the place in the panel, W its
// length and D the depth from its beginning,
//
//     light += W w(s) color(s) density(s) exp(-D(s)),      D(s) = D(s') + W (s - s') (density(s') + density(s)) / 2,
//
// s' the point before; the weights of a panel's ends are 1/2 for the trapezoidal rule, and 0 for the other. From panel to panel light is
// dimmed by that rule's own sum of density, so that the trapezoidal rule's error does not go beyond the panel: it then falls with the
// cube of its length.
//
// The kernel brings volume/volume_light.glsl and segments/ray_sample.glsl.

#define CORE_MOST_STEPS 768u
#include "arithmetic/kronrod.glsl"
#include "volume/volume_optics.glsl"

#define CORE_WANTS_END 1u
#define CORE_WANTS_BEGINNING 2u
#define CORE_WANTS_VALUE 3u

// Breakpoints in a range that are looked at: with more the segment is piecewise smooth without a look.
#define CORE_MOST_BREAKPOINTS_SEEN 64u

struct core_categories {
    bool has_density, is_density_smooth, has_color, is_color_smooth;
};

struct core_integral {
    elvis_real from, to;
    uint wants;
    // Of the field: bounds over the segment, those over the half at the end, and its value there.
    elvis_real low, high, end_low, end_high, end_value;
    // Only transmittance, by the weights of the points alone; the trapezoidal rule for the outer integral.
    bool is_absorption, is_trapezoid;
    // Panels, points inside each, and where the next sample is: in which panel, at which point of it.
    uint n_steps, n_points, panel, point;
    // At the last point: its place in the panel, and what has come together in the panel.
    elvis_real last_at, last_density, depth, all_depth, red, green, blue;
    uint n_breakpoints;
};

core_integral core_integral_begin(elvis_real from, elvis_real to, elvis_real per_parameter, elvis_real step) {
    core_integral integral;
    integral.from = from;
    integral.to = to;
    integral.wants = from < to ? CORE_WANTS_END : CORE_WANTS_NOTHING;
    integral.low = integral.end_low = -CORE_FAR;
    integral.high = integral.end_high = CORE_FAR;
    integral.end_value = elvis_real(0);
    integral.is_absorption = integral.is_trapezoid = false;
    integral.n_steps = integral.n_points = integral.panel = integral.point = 0u;
    integral.last_at = integral.last_density = integral.depth = integral.all_depth = elvis_real(0);
    integral.red = integral.green = integral.blue = elvis_real(0);
    integral.n_breakpoints = 0u;
    return integral;
}

// Of all Kronrod's points, Gauss' three, or the middle.
elvis_real core_point_at(uint n_points, uint point) {
    const uint index = n_points == 1u ? 3u : n_points == 3u ? 2u * point + 1u : point;
    return core_kronrod_at[min(index, uint(CORE_KRONROD_POINTS - 1))];
}

elvis_real core_point_weight(uint n_points, uint point) {
    const uint index = min(n_points == 3u ? 2u * point + 1u : point, uint(CORE_KRONROD_POINTS - 1));
    return n_points == 1u ? elvis_real(1) : n_points == 3u ? core_gauss_weights[index] : core_kronrod_weights[index];
}

elvis_real core_integral_span(core_integral integral) {
    return integral.wants == CORE_WANTS_END         ? integral.from - integral.to
           : integral.wants == CORE_WANTS_BEGINNING ? integral.to - integral.from
                                                    : elvis_real(0);
}

// Where the next sample is wanted.
elvis_real core_integral_at(core_integral integral) {
    const elvis_real at = integral.point < integral.n_points ? core_point_at(integral.n_points, integral.point) : elvis_real(1);
    const elvis_real share = (elvis_real(integral.panel) + at) / elvis_real(max(integral.n_steps, 1u));
    return integral.wants == CORE_WANTS_END         ? integral.to
           : integral.wants == CORE_WANTS_BEGINNING ? integral.from
                                                    : integral.from + (integral.to - integral.from) * share;
}

bool core_is_zero(elvis_vec3 v) { return core_max_norm(v) == elvis_real(0); }

// Whether a linear function goes on as another at a breakpoint: its values there and slopes, alike but for rounding.
bool core_continues_smoothly(elvis_real below, elvis_real below_slope, elvis_real above, elvis_real above_slope, elvis_real width) {
    const elvis_real rounding = elvis_real(16) * CORE_ROUNDOFF;
    return abs(below_slope - above_slope) <= rounding * max(abs(below_slope), abs(above_slope)) &&
           abs(below - above) <= rounding * (abs(below) + abs(above) + abs(below_slope) * width);
}

core_categories core_categorize(elvis_real low, elvis_real high) {
    uint index = core_piece_index(low), n_seen = 0u;
    core_transfer_piece piece = core_fetch_piece(index);
    bool has_density = piece.density != elvis_real(0) || piece.density_slope != elvis_real(0);
    bool has_color = !core_is_zero(piece.color) || !core_is_zero(piece.color_slope);
    bool is_density_smooth = true, is_color_smooth = true;
    while (index < core_n_breakpoints && CORE_REAL(core_breakpoints, index) < high &&
           (is_density_smooth || is_color_smooth || !has_color)) {
        const elvis_real at = CORE_REAL(core_breakpoints, index), width = at - piece.from;
        const core_transfer_piece above = core_fetch_piece(index + 1u);
        const elvis_vec3 color = core_color_at(piece, at);
        is_density_smooth = is_density_smooth && core_continues_smoothly(piece.density + piece.density_slope * width, piece.density_slope,
                                                                         above.density, above.density_slope, width);
        is_color_smooth = is_color_smooth &&
                          core_continues_smoothly(color.x, piece.color_slope.x, above.color.x, above.color_slope.x, width) &&
                          core_continues_smoothly(color.y, piece.color_slope.y, above.color.y, above.color_slope.y, width) &&
                          core_continues_smoothly(color.z, piece.color_slope.z, above.color.z, above.color_slope.z, width);
        has_density = has_density || above.density != elvis_real(0) || above.density_slope != elvis_real(0);
        has_color = has_color || !core_is_zero(above.color) || !core_is_zero(above.color_slope);
        piece = above;
        index += 1u;
        n_seen += 1u;
        const bool is_too_much = n_seen >= CORE_MOST_BREAKPOINTS_SEEN;
        has_density = has_density || is_too_much;
        has_color = has_color || is_too_much;
        is_density_smooth = is_density_smooth && !is_too_much;
        is_color_smooth = is_color_smooth && !is_too_much;
    }
    return core_categories(has_density, is_density_smooth, has_color, is_color_smooth);
}

void core_choose_rule(inout core_integral integral, inout core_light light, core_categories categories, elvis_real length) {
    const uint n = core_n_steps(length);
    const bool is_smooth = categories.is_density_smooth && (categories.is_color_smooth || !categories.has_color);
    integral.is_absorption = is_smooth && !categories.has_color;
    integral.is_trapezoid = !is_smooth;
    integral.n_points = !is_smooth ? 0u : n == 1u ? 1u : n <= 5u ? 3u : uint(CORE_KRONROD_POINTS);
    integral.n_steps = !is_smooth ? n : max((n + integral.n_points / 2u) / (integral.n_points + 1u), 1u);
    light.error += core_has_too_few_steps(length) ? elvis_real(1) : elvis_real(0);
}

// The point at hand, and on to the next.
void core_add_point(inout core_integral integral, inout core_light light, elvis_real value, elvis_real width) {
    const core_optics optics = core_optics_at(value);
    const bool is_inside = integral.point < integral.n_points;
    const elvis_real at = is_inside ? core_point_at(integral.n_points, integral.point) : elvis_real(1);
    const elvis_real end_weight = integral.is_trapezoid ? elvis_real(0.5LF) : elvis_real(0);
    const elvis_real weight = is_inside ? core_point_weight(integral.n_points, integral.point) : end_weight;
    const elvis_real between = elvis_real(0.5LF) * (at - integral.last_at) * (integral.last_density + optics.density);
    const elvis_real depth = integral.depth + width * between, all_depth = integral.all_depth + width * weight * optics.density;
    const elvis_real share = width * weight * elvis_exp(-depth);
    const elvis_real red = integral.red + share * optics.red, green = integral.green + share * optics.green;
    const elvis_real blue = integral.blue + share * optics.blue;
    const bool is_last = integral.is_absorption ? integral.point + 1u >= integral.n_points : !is_inside;
    if (is_last) {
        core_add_light(light, elvis_vec3(red, green, blue), elvis_exp(-(integral.is_trapezoid ? depth : all_depth)));
    }
    integral.last_at = is_last ? elvis_real(0) : at;
    integral.last_density = optics.density;
    integral.depth = is_last ? elvis_real(0) : depth;
    integral.all_depth = is_last ? elvis_real(0) : all_depth;
    integral.red = is_last ? width * end_weight * optics.red : red;
    integral.green = is_last ? width * end_weight * optics.green : green;
    integral.blue = is_last ? width * end_weight * optics.blue : blue;
    integral.panel += is_last ? 1u : 0u;
    integral.point = is_last ? 0u : integral.point + 1u;
}

// The field's range along the segment, from the sample at its end and then the one at its beginning.
void core_bound_range(inout core_integral integral, core_ray_sample found) {
    const bool is_end = integral.wants == CORE_WANTS_END;
    const elvis_real none = elvis_real(0), change = core_integral_span(integral) * found.slope, beyond = found.bend + found.error;
    const elvis_real low = found.value + min(change, none) - beyond, high = found.value + max(change, none) + beyond;
    // Bounds without a number say nothing.
    integral.low = low > integral.low ? low : integral.low;
    integral.high = high < integral.high ? high : integral.high;
    const elvis_real half_change = elvis_real(0.5LF) * change, near = elvis_real(0.375LF) * found.bend + elvis_real(3) * found.error;
    const elvis_real near_low = found.value + min(half_change, none) - near;
    const elvis_real near_high = found.value + max(half_change, none) + near;
    const elvis_real both_low = min(near_low, integral.end_low), both_high = max(near_high, integral.end_high);
    integral.low = !is_end && both_low > integral.low ? both_low : integral.low;
    integral.high = !is_end && both_high < integral.high ? both_high : integral.high;
    integral.end_low = is_end ? near_low : integral.end_low;
    integral.end_high = is_end ? near_high : integral.end_high;
    integral.end_value = is_end ? found.value : integral.end_value;
}

// An end of the segment.
void core_add_end(inout core_integral integral, inout core_light light, core_ray_sample found, elvis_real length) {
    const bool is_end = integral.wants == CORE_WANTS_END;
    core_bound_range(integral, found);
    const core_categories categories = core_categorize(integral.low, integral.high);
    core_light chosen = light;
    core_choose_rule(integral, chosen, categories, length);
    light.error = is_end ? light.error : chosen.error;
    const core_optics optics = core_optics_at(found.value);
    const elvis_real weight = integral.is_trapezoid ? elvis_real(0.5LF) * length / elvis_real(integral.n_steps) : elvis_real(0);
    integral.last_density = optics.density;
    integral.red = weight * optics.red;
    integral.green = weight * optics.green;
    integral.blue = weight * optics.blue;
    integral.wants = !categories.has_density ? CORE_WANTS_NOTHING : is_end ? CORE_WANTS_BEGINNING : CORE_WANTS_VALUE;
    integral.n_steps = categories.has_density ? integral.n_steps : 0u;
}

void core_integral_add(inout core_integral integral, inout core_light light, core_ray_sample found, core_accuracy wanted,
                       inout core_held_piece held, inout uint work) {
    const bool is_value = integral.wants == CORE_WANTS_VALUE;
    const elvis_real length = (integral.to - integral.from) * wanted.per_parameter;
    if (!is_value) {
        core_add_end(integral, light, found, length);
    }
    const elvis_real width = length / elvis_real(max(integral.n_steps, 1u));
    if (is_value) {
        core_add_point(integral, light, found.value, width);
    }
    // The end is known.
    const bool wants_value = integral.wants == CORE_WANTS_VALUE, is_all = wants_value && integral.panel >= integral.n_steps;
    const bool is_at_end = wants_value && integral.panel + 1u == integral.n_steps && integral.point >= integral.n_points;
    if (is_at_end) {
        core_add_point(integral, light, integral.end_value, width);
    }
    integral.wants = is_all || is_at_end ? CORE_WANTS_NOTHING : integral.wants;
}
