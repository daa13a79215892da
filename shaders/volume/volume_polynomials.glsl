// The volume rendering integral along a segment, by polynomials through samples with slopes: a cubic through those at both ends of a step,
// or a quintic through a third one inside, where the cubic may not be good enough. Steps adapt to what each channel may be off.
//
// The sample inside is not in the middle, so that fields that are symmetric in the element do not look simpler than they are.
//
// The error of a polynomial is estimated from the Chebyshev coefficients of its highest terms. These are taken to decay as the last two
// pairs of them do, with a margin, since fields in coarse elements do not decay evenly. The error of a cubic is not less than a small
// share of how far the field may be from a line (segments/ray_sample.glsl): two samples alone are not believed where bounds say that the
// field may do much in between.
//
// The kernel brings volume/volume_exact.glsl.

// The first sample is at the end of the segment, where the mapping has been evaluated.
#define CORE_WANTS_RIGHT 1u
#define CORE_WANTS_LEFT 2u
#define CORE_WANTS_INNER 3u
// No sample.
#define CORE_WANTS_TO_INTEGRATE 4u

#define CORE_INNER_AT elvis_real(0.4375LF)
// Over the length of the segment: steps are not made shorter.
#define CORE_SHORTEST_STEP elvis_real(0.0009765625LF)
// Share of how far the field may be from a line that a cubic is off at least.
#define CORE_CUBIC_SHARE elvis_real(0.0625LF)
// Of a quintic that shows less of how far the field may be from a line than this, samples may have missed something...
#define CORE_SHOWN_SHARE elvis_real(0.0009765625LF)
// ... as large as this share of it, unless ...
#define CORE_QUINTIC_SHARE elvis_real(0.00390625LF)
// ... the step is so short, in reference coordinates, that the field has no more than this many degrees of freedom in it.
#define CORE_RESOLVED elvis_real(8)
#define CORE_MARGIN elvis_real(15)
// Share of what a step may be off that a line may be.
#define CORE_LINE_SHARE elvis_real(0.125LF)
// Of pairs of Chebyshev coefficients: none is believed to be faster; one that is slower is none.
#define CORE_FASTEST_DECAY elvis_real(0.25LF)
#define CORE_SLOWEST_DECAY elvis_real(0.75LF)
// Share of what remains of the tolerance that any step may use.
#define CORE_LEAST_SHARE elvis_real(0.0625LF)

// The field, and how it changes with the ray's parameter.
struct core_step_sample {
    elvis_real value, slope;
};

struct core_integral {
    elvis_real from, to;
    // The step, and samples at its ends, inside, and at the end of the segment.
    elvis_real left, right;
    core_step_sample left_sample, right_sample, inner_sample, end_sample;
    bool has_end, has_left;
    // What the next polynomial is: a quintic; a line through the right sample, with `bend` for how far the field may be from it.
    bool has_inner, is_line;
    uint wants;
    // Largest error of a sample, and deviation from a line over the step; change of reference coordinates with the parameter.
    elvis_real error, bend, speed;
    uint n_steps, n_breakpoints;
};

core_integral core_integral_begin(elvis_real from, elvis_real to, elvis_real per_parameter, elvis_real step) {
    core_integral integral;
    integral.from = integral.left = from;
    integral.to = to;
    integral.right = elvis_real(1.5LF) * step < to - from ? from + step : to;
    integral.left_sample = integral.right_sample = integral.inner_sample = integral.end_sample =
        core_step_sample(elvis_real(0), elvis_real(0));
    integral.has_end = false;
    integral.wants = from < to ? CORE_WANTS_RIGHT : CORE_WANTS_NOTHING;
    integral.has_left = integral.has_inner = integral.is_line = false;
    integral.error = integral.bend = integral.speed = elvis_real(0);
    integral.n_steps = integral.n_breakpoints = 0u;
    return integral;
}

bool core_integral_wants_sample(const core_integral integral) {
    return integral.wants != CORE_WANTS_NOTHING && integral.wants != CORE_WANTS_TO_INTEGRATE;
}

bool core_is_shortest(const core_integral integral) {
    return integral.right - integral.left <= CORE_SHORTEST_STEP * (integral.to - integral.from);
}

// Up to where light is integrated, and how long the step from there is.
// Not before a step is done: each dispatch gets on, whatever has used up its time before.
bool core_integral_may_stop(const core_integral integral) { return integral.left > integral.from; }
elvis_real core_integral_done(const core_integral integral) { return integral.left; }
elvis_real core_integral_step(const core_integral integral) { return integral.right - integral.left; }

// Where the next sample is wanted, and how far from there its line is wanted.
elvis_real core_integral_at(const core_integral integral) {
    const elvis_real inner = integral.left + CORE_INNER_AT * (integral.right - integral.left);
    return integral.wants == CORE_WANTS_LEFT ? integral.left : integral.wants == CORE_WANTS_RIGHT ? integral.right : inner;
}

elvis_real core_integral_span(const core_integral integral) {
    const elvis_real width = integral.right - integral.left;
    return integral.wants == CORE_WANTS_RIGHT ? -width : width;
}

// Divisions take ten times as long as products.
#define CORE_ONE_THIRD elvis_real(0.33333333333333333333LF)
#define CORE_ONE_FIFTH elvis_real(0.2LF)

core_fitted core_step_polynomial(const core_integral integral) {
    const bool with_inner = integral.has_inner;
    const core_step_sample left = integral.left_sample, right = integral.right_sample;
    const elvis_real width = integral.right - integral.left, c0 = left.value, c3 = right.value;
    const elvis_real c1 = c0 + CORE_ONE_THIRD * width * left.slope, c2 = c3 - CORE_ONE_THIRD * width * right.slope;
    const elvis_real cubic = c3 - c0 + elvis_real(3) * (c1 - c2), square = elvis_real(3) * (c0 - elvis_real(2) * c1 + c2);
    // What is added to it: t^2 (1 - t)^2 (shift + tilt (t - at)).
    const elvis_real at = CORE_INNER_AT, rest = elvis_real(1) - CORE_INNER_AT;
    const elvis_real there = rest * rest * rest * c0 + elvis_real(3) * rest * at * (rest * c1 + at * c2) + at * at * at * c3;
    const elvis_real slope_there =
        elvis_real(3) * (rest * rest * (c1 - c0) + elvis_real(2) * rest * at * (c2 - c1) + at * at * (c3 - c2));
    const elvis_real per_bubble = elvis_real(1) / (at * at * rest * rest), bubble_slope = elvis_real(2) * at * rest * (rest - at);
    const elvis_real shift = with_inner ? (integral.inner_sample.value - there) * per_bubble : elvis_real(0);
    const elvis_real tilt =
        with_inner ? (width * integral.inner_sample.slope - slope_there - bubble_slope * shift) * per_bubble : elvis_real(0);
    core_fitted fitted;
    fitted.p.c[0] = c0;
    fitted.p.c[1] = CORE_ONE_FIFTH * (elvis_real(2) * c0 + elvis_real(3) * c1);
    fitted.p.c[2] = elvis_real(0.5LF) * CORE_ONE_FIFTH * (c0 + elvis_real(6) * c1 + elvis_real(3) * c2 + shift - at * tilt);
    fitted.p.c[3] = elvis_real(0.5LF) * CORE_ONE_FIFTH * (c3 + elvis_real(6) * c2 + elvis_real(3) * c1 + shift + rest * tilt);
    fitted.p.c[4] = CORE_ONE_FIFTH * (elvis_real(2) * c3 + elvis_real(3) * c2);
    fitted.p.c[5] = c3;
    const elvis_real level = shift - at * tilt;
    const elvis_real a2 = square + level, a3 = cubic - elvis_real(2) * level + tilt, a4 = level - elvis_real(2) * tilt;
    fitted.powers.c[0] = c0;
    fitted.powers.c[1] = width * left.slope;
    fitted.powers.c[2] = a2;
    fitted.powers.c[3] = a3;
    fitted.powers.c[4] = a4;
    fitted.powers.c[5] = tilt;
    // From them the Chebyshev coefficients from the second on.
    const elvis_real second =
        abs(a2 * elvis_real(0.125LF) + a3 * elvis_real(0.1875LF) + a4 * elvis_real(0.21875LF) + tilt * elvis_real(0.234375LF));
    const elvis_real third = abs(a3 * elvis_real(0.03125LF) + a4 * elvis_real(0.0625LF) + tilt * elvis_real(0.087890625LF));
    const elvis_real last = abs(a4 * elvis_real(0.0078125LF) + tilt * elvis_real(0.01953125LF)) + abs(tilt) * elvis_real(0.001953125LF);
    const elvis_real decay = clamp(last / max(second + third, elvis_real(1e-30LF)), CORE_FASTEST_DECAY, CORE_SLOWEST_DECAY);
    const elvis_real of_quintic = CORE_MARGIN * last * decay / (elvis_real(1) - decay);
    const elvis_real of_cubic = max(max(third, second * CORE_FASTEST_DECAY), CORE_CUBIC_SHARE * integral.bend) *
                                (CORE_FASTEST_DECAY / (elvis_real(1) - CORE_FASTEST_DECAY));
    const elvis_real size = max(abs(c0), abs(c3)) + width * max(abs(left.slope), abs(right.slope));
    // Above 0, as it divides.
    fitted.rounding = max(integral.error + elvis_real(8) * CORE_ROUNDOFF * size, elvis_real(1e-30LF));
    fitted.error = (integral.is_line ? integral.bend : with_inner ? of_quintic : of_cubic) + fitted.rounding;
    const bool is_resolved = elvis_real(0.5LF * (CORE_FIELD_DEGREE + 1)) * width * integral.speed <= CORE_RESOLVED;
    const bool is_shown = second + third + last >= CORE_SHOWN_SHARE * integral.bend;
    fitted.unseen = with_inner && !is_resolved && !is_shown ? CORE_QUINTIC_SHARE * integral.bend : elvis_real(0);
    return fitted;
}

// What a step may be off, and whether it is worth while to integrate it.
struct core_judgement {
    elvis_real allowed;
    // No other sample would make it better.
    bool is_exhausted;
    bool is_tried;
};

// `held`: the piece that holds the step's beginning, or another one.
core_judgement core_judge_step(const core_integral integral, const core_fitted fitted, const core_light light, core_accuracy wanted,
                               const core_held_piece held) {
    const elvis_real width = integral.right - integral.left, tolerance = wanted.tolerance;
    // Where the tolerance is missed already there is no point in looking more closely than elsewhere.
    const elvis_real error = core_light_error(light);
    const elvis_real budget = error < tolerance ? max(tolerance - error, CORE_LEAST_SHARE * tolerance) : tolerance;
    const elvis_real least = core_least(fitted.p), most = core_most(fitted.p);
    const bool is_whole = least - fitted.error >= held.lower && most + fitted.error < held.upper;
    // What cannot be good, and a cubic that may not be, is not tried: another sample is.
    const elvis_real seen_length = light.transmittance * width * wanted.per_parameter;
    const elvis_real worst = seen_length * (fitted.error - fitted.rounding);
    core_judgement judgement;
    judgement.allowed = budget * max(width / max(wanted.ahead - (integral.left - integral.from), width), CORE_LEAST_SHARE);
    judgement.is_exhausted = integral.has_inner && (core_is_shortest(integral) || fitted.error <= elvis_real(2) * fitted.rounding);
    // The bound of a line is what it may well be off.
    const elvis_real acceptable = integral.is_line ? CORE_LINE_SHARE * judgement.allowed : judgement.allowed;
    const bool is_hopeful = is_whole ? worst * held.steepness <= acceptable
                                     : integral.has_inner || worst * elvis_real(core_steepest) <= acceptable;
    const elvis_real beyond = fitted.error + fitted.unseen;
    const bool stays_whole = least - beyond >= held.lower && most + beyond < held.upper;
    const bool is_harmless = seen_length * fitted.unseen * (stays_whole ? held.steepness : elvis_real(core_steepest)) <= acceptable &&
                             (stays_whole || CORE_HAS_JUMPS == 0);
    judgement.is_tried = (is_hopeful && (fitted.unseen <= fitted.error || is_harmless)) || judgement.is_exhausted;
    return judgement;
}

// A sample where one was wanted.
void core_integral_add(inout core_integral integral, inout core_light light, const core_ray_sample found, core_accuracy wanted,
                       inout core_held_piece held, inout uint work) {
    const bool is_left = integral.wants == CORE_WANTS_LEFT, is_inner = integral.wants == CORE_WANTS_INNER;
    const bool is_right = integral.wants == CORE_WANTS_RIGHT, is_end = is_right && integral.right >= integral.to;
    integral.error = max(integral.error, found.error);
    const core_step_sample here = core_step_sample(found.value, found.slope);
    if (is_left) {
        integral.left_sample = here;
    } else if (is_right) {
        integral.right_sample = here;
    } else {
        integral.inner_sample = here;
    }
    if (is_end) {
        integral.end_sample = here;
    }
    integral.has_end = integral.has_end || is_end;
    integral.has_left = integral.has_left || is_left;
    integral.speed = core_max_norm(found.w);
    integral.bend = is_right ? found.bend : is_left ? max(integral.bend, found.bend) : integral.bend;
    // A line from the first end may do, mostly not.
    integral.is_line = !integral.has_left;
    integral.has_inner = is_inner;
    if (integral.is_line) {
        const core_step_sample right = integral.right_sample;
        integral.left_sample = core_step_sample(right.value - (integral.right - integral.left) * right.slope, right.slope);
    }
    const core_judgement judgement = core_judge_step(integral, core_step_polynomial(integral), light, wanted, held);
    integral.wants = judgement.is_tried || is_inner ? CORE_WANTS_TO_INTEGRATE : integral.is_line ? CORE_WANTS_LEFT : CORE_WANTS_INNER;
}

// On to the next step: to the end, or as far again and a little more. Otherwise shortens the step to the inner sample, or
// wants the sample that is missing.
void core_choose_step(inout core_integral integral, bool is_good) {
    const bool is_shorter = !is_good && integral.has_inner;
    const elvis_real width = integral.right - integral.left, farther = integral.right + elvis_real(1.5LF) * width;
    const elvis_real inner = integral.left + CORE_INNER_AT * width;
    const bool is_last = farther >= integral.to, is_known = is_last && integral.has_end;
    // Scales the bound to the shortened step.
    integral.bend *= is_shorter ? CORE_INNER_AT * CORE_INNER_AT : elvis_real(1);
    if (is_good) {
        integral.left = integral.right;
        integral.left_sample = integral.right_sample;
        integral.right = is_last ? integral.to : farther;
    }
    if (is_shorter) {
        integral.right = inner;
        integral.right_sample = integral.inner_sample;
    } else if (is_good && is_known) {
        integral.right_sample = integral.end_sample;
    }
    integral.wants = is_good ? (integral.left >= integral.to ? CORE_WANTS_NOTHING : is_known ? CORE_WANTS_TO_INTEGRATE : CORE_WANTS_RIGHT)
                     : integral.is_line ? CORE_WANTS_LEFT
                     : is_shorter       ? CORE_WANTS_TO_INTEGRATE
                                        : CORE_WANTS_INNER;
    integral.has_left = integral.has_left || is_good;
    integral.has_inner = integral.is_line = false;
}

// As much of the integral as samples allow. `work` grows by what loops have done. Up to integral.left light is done.
void core_integrate_step(inout core_integral integral, inout core_light light, core_accuracy wanted, inout core_held_piece held,
                          inout uint work) {
    while (integral.wants == CORE_WANTS_TO_INTEGRATE) {
        const elvis_real length = (integral.right - integral.left) * wanted.per_parameter;
        const core_fitted fitted = core_step_polynomial(integral);
        core_hold_value(held, fitted.p.c[0]);
        const core_held_piece beginning = held;
        const core_judgement judgement = core_judge_step(integral, fitted, light, wanted, held);
        const elvis_real allowed = judgement.allowed;
        core_light next = light;
        uint n_breakpoints = 0u;
        elvis_real missed = elvis_real(0);
        work += CORE_WORK_A_STEP;
        if (judgement.is_tried) {
            const elvis_real most = judgement.is_exhausted ? CORE_FAR : light.error + allowed;
            core_add_polynomial(next, fitted, length, most, CORE_QUADRATURE_SHARE * allowed, held, n_breakpoints, missed, work);
        }
        // The rest is not of the polynomial's making.
        const bool is_rounding = fitted.error <= elvis_real(2) * fitted.rounding && missed <= allowed;
        const bool is_good = (judgement.is_tried && next.error - light.error <= allowed) ||
                             (integral.has_inner && (core_is_shortest(integral) || is_rounding));
        integral.n_steps += is_good ? 1u : 0u;
        integral.n_breakpoints += is_good ? n_breakpoints : 0u;
        if (is_good) {
            light = next;
        } else {
            held = beginning;
        }
        core_choose_step(integral, is_good);
        if (integral.wants != CORE_WANTS_TO_INTEGRATE) {
            break;
        }
    }
}
