// The volume rendering integral along a segment by the trapezoidal rule, in steps halved until the rule agrees with
// itself over two half steps (B. Nelson, 2012, section 6.4.4). Steps are dyadic: [index, index + 1] / 2^level of the segment, from one to
// the next without a stack.
//
// The rule may agree with itself by chance: where the field bends both ways, or around a narrow peak between samples. So slopes count, too. The
// field between two samples is taken to be the cubic through their values and slopes. What the rule misses of that is by how much it bends.
// Where several pieces of the transfer function hold its control points, density and light at the ends of each piece are compared with
// those of the rule. No step is longer than CORE_FIRST_LEVEL halvings make it, by the field's degree: the cubics between fewer samples could
// miss a peak whole.
//
// The kernel brings volume/volume_light.glsl and segments/ray_sample.glsl.

#include "volume/volume_optics.glsl"

#define CORE_WANTS_LEFT 1u
#define CORE_WANTS_RIGHT 2u
#define CORE_WANTS_MIDDLE 3u

#define CORE_MOST_LEVELS 14u
// Samples in one segment, and pieces of the transfer function between two: below where drivers end loops.
#define CORE_MOST_SAMPLES 320u
#define CORE_MOST_PIECES_BETWEEN 6u
// Share of what remains of the tolerance that any step may use.
#define CORE_LEAST_SHARE elvis_real(0.0625LF)

// The field and its slope, density and light.
struct core_optics_sample {
    elvis_real value, slope;
    core_optics optics;
};

struct core_integral {
    elvis_real from, to;
    uint wants, level, index, n_samples;
    core_optics_sample left, middle, right;
    // Largest of a sample.
    elvis_real error;
    uint n_steps, n_breakpoints;
};

core_integral core_integral_begin(elvis_real from, elvis_real to, elvis_real per_parameter, elvis_real step) {
    const elvis_real none = elvis_real(0);
    core_integral integral;
    integral.from = from;
    integral.to = to;
    integral.wants = from < to ? CORE_WANTS_LEFT : CORE_WANTS_NOTHING;
    integral.level = CORE_FIRST_LEVEL;
    integral.index = integral.n_samples = 0u;
    integral.left = integral.middle = integral.right = core_optics_sample(none, none, core_optics(none, none, none, none));
    integral.error = none;
    integral.n_steps = integral.n_breakpoints = 0u;
    return integral;
}

elvis_real core_integral_at(core_integral integral) {
    const elvis_real in_step = integral.wants == CORE_WANTS_LEFT    ? elvis_real(0)
                               : integral.wants == CORE_WANTS_RIGHT ? elvis_real(1)
                                                                    : elvis_real(0.5LF);
    const elvis_real share = (elvis_real(integral.index) + in_step) / elvis_real(1u << integral.level);
    return share >= elvis_real(1) ? integral.to : integral.from + (integral.to - integral.from) * share;
}

// Light of a step, and its transmittance, by the trapezoidal rule.
elvis_vec4 core_trapezoid(core_optics left, core_optics right, elvis_real width) {
    const elvis_real half_width = elvis_real(0.5LF) * width, transmittance = elvis_exp(-half_width * (left.density + right.density));
    return elvis_vec4(half_width * (core_light_of(left) + transmittance * core_light_of(right)), transmittance);
}

// How far density and light of a piece at a value are from those of the rule between two samples.
elvis_real core_deviation(core_transfer_piece piece, elvis_real at, core_optics_sample first, core_optics_sample second) {
    const elvis_real change = second.value - first.value, none = elvis_real(0);
    const elvis_real share = first.value == second.value ? none : clamp((at - first.value) / change, none, elvis_real(1));
    const core_optics there = core_optics_of(piece, at);
    return abs(there.density - mix(first.optics.density, second.optics.density, share)) +
           core_max_norm(core_light_of(there) - mix(core_light_of(first.optics), core_light_of(second.optics), share));
}

// What the rule misses between two samples of light and depth. `step`: the distance of their parameters; `width`: that along the ray.
elvis_real core_hidden_error(core_optics_sample first, core_optics_sample second, elvis_real step, elvis_real width,
                             inout uint n_breakpoints) {
    const elvis_real after = first.value + step * first.slope / elvis_real(3), before = second.value - step * second.slope / elvis_real(3);
    const elvis_real low = min(min(first.value, second.value), min(after, before));
    const elvis_real high = max(max(first.value, second.value), max(after, before));
    const uint index = core_piece_index(low);
    uint n = 0u;
    elvis_real largest = elvis_real(0), steepest = elvis_real(0), start = low;
    bool is_more = true;
    while (is_more && n < CORE_MOST_PIECES_BETWEEN) {
        const core_transfer_piece piece = core_fetch_piece(index + n);
        is_more = index + n < core_n_breakpoints && CORE_REAL(core_breakpoints, index + n) < high;
        const elvis_real end = is_more ? CORE_REAL(core_breakpoints, index + n) : high;
        largest = max(largest, max(core_deviation(piece, start, first, second), core_deviation(piece, end, first, second)));
        steepest = max(steepest, piece.steepness);
        start = end;
        n += 1u;
    }
    n_breakpoints += n - 1u;
    // Breakpoints do nothing within one piece. With two the difference is a triangle.
    const elvis_real at_breakpoints = n == 1u ? elvis_real(0) : largest * (n == 2u ? elvis_real(0.5LF) : elvis_real(1));
    // The mean of the cubic less that of the line is a twelfth of this. Three times as much: the difference of the rule from that with steps
    // twice as long.
    const elvis_real bend = elvis_real(0.25LF) * step * abs(first.slope - second.slope);
    const elvis_real error = width * (at_breakpoints + steepest * bend);
    return is_more ? max(error, elvis_real(1)) : error;
}

// The next step: half of this one; or, if this one `is_taken`, one of its length, or twice as long if `may_be_longer` and that is dyadic.
void core_choose_dyadic_step(inout core_integral integral, bool is_taken, bool may_be_longer) {
    const uint next = integral.index + 1u;
    const bool is_over = is_taken && next >= (1u << integral.level);
    const bool is_longer = is_taken && !is_over && (next & 1u) == 0u && may_be_longer && integral.level > CORE_FIRST_LEVEL;
    if (is_taken) {
        integral.left = integral.right;
    } else {
        integral.right = integral.middle;
    }
    integral.index = is_longer ? next / 2u : is_taken ? next : 2u * integral.index;
    integral.level = is_longer ? integral.level - 1u : is_taken ? integral.level : integral.level + 1u;
    integral.wants = is_over ? CORE_WANTS_NOTHING : is_taken ? CORE_WANTS_RIGHT : CORE_WANTS_MIDDLE;
}

// The step with its three samples, if the rule is good enough. `steepness`: that of the piece in its middle.
void core_try_step(inout core_integral integral, inout core_light light, elvis_real steepness, core_accuracy wanted) {
    const elvis_real step = (integral.to - integral.from) / elvis_real(1u << integral.level), width = step * wanted.per_parameter;
    const elvis_real half_step = elvis_real(0.5LF) * step, half_width = elvis_real(0.5LF) * width;
    const elvis_vec4 one = core_trapezoid(integral.left.optics, integral.right.optics, width);
    const elvis_vec4 first = core_trapezoid(integral.left.optics, integral.middle.optics, half_width);
    const elvis_vec4 second = core_trapezoid(integral.middle.optics, integral.right.optics, half_width);
    const elvis_vec4 two = elvis_vec4(first.xyz + first.w * second.xyz, first.w * second.w);
    const elvis_real off = core_max_norm(one.xyz - two.xyz) + abs(one.w - two.w);
    uint n_breakpoints = 0u;
    const elvis_real hidden = core_hidden_error(integral.left, integral.middle, half_step, half_width, n_breakpoints) +
                              core_hidden_error(integral.middle, integral.right, half_step, half_width, n_breakpoints);
    const elvis_real step_error = light.transmittance * max(off, min(hidden, elvis_real(1)));
    const elvis_real rounding = light.transmittance * width * steepness * integral.error;
    // What is flagged already is not looked at more closely than what is not.
    const elvis_real error = core_light_error(light);
    const elvis_real budget = error < wanted.tolerance ? wanted.tolerance - error : wanted.tolerance;
    const elvis_real rest = wanted.ahead - step * elvis_real(integral.index);
    const elvis_real allowed = budget * max(step / max(rest, step), CORE_LEAST_SHARE);
    const bool has_room = integral.n_samples < CORE_MOST_SAMPLES, is_bounded = integral.level < CORE_MOST_LEVELS && has_room;
    const bool is_taken = step_error <= max(allowed, rounding) || !is_bounded;
    if (is_taken) {
        light.error += step_error;
        light.rounding += rounding * rounding;
        core_add_light(light, two.xyz, two.w);
    }
    integral.n_steps += is_taken ? 1u : 0u;
    integral.n_breakpoints += is_taken ? n_breakpoints : 0u;
    // Twice as far where the rule's error, which goes with the cube, is likely to allow it, or no samples remain.
    core_choose_dyadic_step(integral, is_taken, elvis_real(4) * step_error <= allowed || !has_room);
}

void core_integral_add(inout core_integral integral, inout core_light light, core_ray_sample found, core_accuracy wanted,
                       inout core_held_piece held, inout uint work) {
    const bool is_left = integral.wants == CORE_WANTS_LEFT, is_middle = integral.wants == CORE_WANTS_MIDDLE;
    integral.n_samples += 1u;
    integral.error = max(integral.error, found.error);
    const core_transfer_piece piece = core_fetch_piece(core_piece_index(found.value));
    const core_optics_sample here = core_optics_sample(found.value, found.slope, core_optics_of(piece, found.value));
    if (is_left) {
        integral.left = here;
    } else if (is_middle) {
        integral.middle = here;
    } else {
        integral.right = here;
    }
    integral.wants = is_left ? CORE_WANTS_RIGHT : CORE_WANTS_MIDDLE;
    if (is_middle) {
        core_try_step(integral, light, piece.steepness, wanted);
    }
}
