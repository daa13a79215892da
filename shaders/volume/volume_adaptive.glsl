// The volume rendering integral along a segment by the trapezoidal rule, in steps halved until the rule agrees with
// itself over two half steps (B. Nelson, 2012, section 6.4.4). Steps are dyadic: [index, index + 1] / 2^level of the segment, from one to
// the next without a stack.
//
// A narrow peak between samples would leave the rule in agreement. So what breakpoints between them do is bounded, too: the field
// between two samples is taken to stay among the control points of the cubic through their values and slopes, and where that is
// in several pieces of the transfer function, density and light at the ends of each are compared with those of the rule.
//
// The kernel brings volume/volume_light.glsl.

#include "volume/volume_optics.glsl"

#define CORE_WANTS_NOTHING 0u
#define CORE_WANTS_LEFT 1u
#define CORE_WANTS_RIGHT 2u
#define CORE_WANTS_MIDDLE 3u

#define CORE_MOST_LEVELS 14u
// Samples in one segment, and pieces of the transfer function between two: below where drivers end loops.
#define CORE_MOST_SAMPLES 320u
#define CORE_MOST_PIECES_BETWEEN 6u
// Of what the kernel does in one dispatch.
#define CORE_WORK_A_SAMPLE 3u
// Share of what is left of the tolerance that any step may use.
#define CORE_LEAST_SHARE elvis_real(0.0625LF)

struct core_integral {
    elvis_real from, to;
    uint wants, level, index, n_samples;
    elvis_real left_value, left_slope, middle_value, middle_slope, right_value, right_slope;
    core_optics left, middle, right;
    // Largest of a sample.
    elvis_real error;
    uint n_steps, n_breakpoints;
};

core_integral core_integral_begin(elvis_real from, elvis_real to, elvis_real per_parameter, elvis_real step) {
    core_integral integral;
    integral.from = from;
    integral.to = to;
    integral.wants = from < to ? CORE_WANTS_LEFT : CORE_WANTS_NOTHING;
    integral.level = integral.index = integral.n_samples = 0u;
    integral.left_value = integral.left_slope = integral.middle_value = integral.middle_slope = elvis_real(0);
    integral.right_value = integral.right_slope = integral.error = elvis_real(0);
    integral.left = integral.middle = integral.right = core_optics(elvis_real(0), elvis_real(0), elvis_real(0), elvis_real(0));
    integral.n_steps = integral.n_breakpoints = 0u;
    return integral;
}

// All of a segment is done at once.
bool core_integral_may_stop(core_integral integral) { return false; }
bool core_integral_wants_sample(core_integral integral) { return integral.wants != CORE_WANTS_NOTHING; }
elvis_real core_integral_done(core_integral integral) { return integral.from; }
elvis_real core_integral_step(core_integral integral) { return CORE_FAR; }
elvis_real core_integral_span(core_integral integral) { return elvis_real(0); }

// Where the next sample is wanted.
elvis_real core_integral_at(core_integral integral) {
    const elvis_real in_step = integral.wants == CORE_WANTS_LEFT    ? elvis_real(0)
                               : integral.wants == CORE_WANTS_RIGHT ? elvis_real(1)
                                                                    : elvis_real(0.5LF);
    const elvis_real share = (elvis_real(integral.index) + in_step) / elvis_real(1u << integral.level);
    return share >= elvis_real(1) ? integral.to : integral.from + (integral.to - integral.from) * share;
}

// Light of a step, and what is let through, by the trapezoidal rule.
elvis_vec4 core_trapezoid(core_optics left, core_optics right, elvis_real width) {
    const elvis_real half_width = elvis_real(0.5LF) * width, through = elvis_exp(-half_width * (left.density + right.density));
    return elvis_vec4(half_width * (core_light_of(left) + through * core_light_of(right)), through);
}

elvis_real core_largest(elvis_vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

// How far density and light of a piece at a value are from those of the rule between two samples.
elvis_real core_deviation(core_transfer_piece piece, elvis_real at, elvis_real first, core_optics first_optics, elvis_real second,
                          core_optics second_optics) {
    const elvis_real share = first == second ? elvis_real(0) : clamp((at - first) / (second - first), elvis_real(0), elvis_real(1));
    const core_optics there = core_optics_of(piece, at);
    return abs(there.density - mix(first_optics.density, second_optics.density, share)) +
           core_largest(core_light_of(there) - mix(core_light_of(first_optics), core_light_of(second_optics), share));
}

// Bounds what breakpoints between two samples do to light and depth, `width` apart; slopes times the distance of the parameters.
elvis_real core_hidden_error(elvis_real first, elvis_real first_change, core_optics first_optics, elvis_real second,
                             elvis_real second_change, core_optics second_optics, elvis_real width, inout uint n_breakpoints) {
    const elvis_real after = first + first_change / elvis_real(3), before = second - second_change / elvis_real(3);
    const elvis_real low = min(min(first, second), min(after, before)), high = max(max(first, second), max(after, before));
    const uint index = core_piece_index(low);
    uint n = 0u;
    elvis_real largest = elvis_real(0), start = low;
    bool is_more = true;
    while (is_more && n < CORE_MOST_PIECES_BETWEEN) {
        const core_transfer_piece piece = core_fetch_piece(index + n);
        is_more = index + n < core_n_breakpoints && core_breakpoints[index + n] < high;
        const elvis_real end = is_more ? core_breakpoints[index + n] : high;
        largest = max(largest, max(core_deviation(piece, start, first, first_optics, second, second_optics),
                                   core_deviation(piece, end, first, first_optics, second, second_optics)));
        start = end;
        n += 1u;
    }
    n_breakpoints += n - 1u;
    // Within one piece the rule sees all. With two the difference is a triangle.
    const elvis_real error = n == 1u ? elvis_real(0) : width * largest * (n == 2u ? elvis_real(0.5LF) : elvis_real(1));
    return is_more ? max(error, elvis_real(1)) : error;
}

void core_integral_add(inout core_integral integral, inout core_light light, elvis_real value, elvis_real slope, elvis_real error,
                       elvis_real bend, elvis_real per_parameter, elvis_real tolerance, elvis_real ahead,
                       inout core_held_piece held, inout uint work) {
    const uint given = integral.wants;
    const bool is_left = given == CORE_WANTS_LEFT, is_right = given == CORE_WANTS_RIGHT, is_middle = given == CORE_WANTS_MIDDLE;
    integral.n_samples += 1u;
    integral.error = max(integral.error, error);
    const core_transfer_piece piece = core_fetch_piece(core_piece_index(value));
    const core_optics optics = core_optics_of(piece, value);
    if (is_left) {
        integral.left = optics;
    }
    if (is_middle) {
        integral.middle = optics;
    }
    if (is_right) {
        integral.right = optics;
    }
    integral.left_value = is_left ? value : integral.left_value;
    integral.left_slope = is_left ? slope : integral.left_slope;
    integral.right_value = is_right ? value : integral.right_value;
    integral.right_slope = is_right ? slope : integral.right_slope;
    integral.middle_value = is_middle ? value : integral.middle_value;
    integral.middle_slope = is_middle ? slope : integral.middle_slope;
    integral.wants = is_left ? CORE_WANTS_RIGHT : CORE_WANTS_MIDDLE;
    if (is_middle) {
        const elvis_real n_parts = elvis_real(1u << integral.level), step = (integral.to - integral.from) / n_parts;
        const elvis_real width = step * per_parameter;
        const core_optics left = integral.left, middle = integral.middle, right = integral.right;
        const elvis_vec4 one = core_trapezoid(left, right, width);
        const elvis_vec4 first = core_trapezoid(left, middle, elvis_real(0.5LF) * width);
        const elvis_vec4 second = core_trapezoid(middle, right, elvis_real(0.5LF) * width);
        const elvis_vec4 two = elvis_vec4(first.xyz + first.w * second.xyz, first.w * second.w);
        const elvis_real off = core_largest(one.xyz - two.xyz) + abs(one.w - two.w);
        uint n_breakpoints = 0u;
        const elvis_real change = elvis_real(0.5LF) * step;
        const elvis_real hidden =
            core_hidden_error(integral.left_value, change * integral.left_slope, left, integral.middle_value,
                              change * integral.middle_slope, middle, elvis_real(0.5LF) * width, n_breakpoints) +
            core_hidden_error(integral.middle_value, change * integral.middle_slope, middle, integral.right_value,
                              change * integral.right_slope, right, elvis_real(0.5LF) * width, n_breakpoints);
        const elvis_real step_error = light.left * max(off, min(hidden, elvis_real(1)));
        const elvis_real rounding = light.left * width * piece.steepness * integral.error;
        // What is flagged already is not looked at more closely than what is not.
        const elvis_real budget = light.error < tolerance ? tolerance - light.error : tolerance;
        const elvis_real rest = ahead - step * elvis_real(integral.index);
        const elvis_real allowed = budget * max(step / max(rest, step), CORE_LEAST_SHARE);
        const bool is_bounded = integral.level < CORE_MOST_LEVELS && integral.n_samples < CORE_MOST_SAMPLES;
        const bool is_good = step_error <= max(allowed, rounding), is_taken = is_good || !is_bounded;
        if (is_taken) {
            light.error += step_error + rounding;
            core_add_light(light, two.xyz, two.w);
        }
        integral.n_steps += is_taken ? 1u : 0u;
        integral.n_breakpoints += is_taken ? n_breakpoints : 0u;
        // On; twice as far if that is dyadic and the rule's error, which goes with the cube, is likely to allow it; with no samples
        // left as far as that is. Or back.
        const uint next = integral.index + 1u;
        const bool is_over = is_taken && next >= (1u << integral.level);
        const bool is_longer = is_taken && !is_over && (next & 1u) == 0u &&
                               (elvis_real(4) * step_error <= allowed || integral.n_samples >= CORE_MOST_SAMPLES);
        if (is_taken) {
            integral.left = right;
        } else {
            integral.right = middle;
        }
        integral.left_value = is_taken ? integral.right_value : integral.left_value;
        integral.left_slope = is_taken ? integral.right_slope : integral.left_slope;
        integral.right_value = is_taken ? integral.right_value : integral.middle_value;
        integral.right_slope = is_taken ? integral.right_slope : integral.middle_slope;
        integral.index = is_longer ? next / 2u : is_taken ? next : 2u * integral.index;
        integral.level = is_longer ? integral.level - 1u : is_taken ? integral.level : integral.level + 1u;
        integral.wants = is_over ? CORE_WANTS_NOTHING : is_taken ? CORE_WANTS_RIGHT : CORE_WANTS_MIDDLE;
    }
}
