// Light of a ray's segment: samples of the field, as the integrator wants them, and its integral of what lies between.
//
// Drivers compile a function's body anew for each function around it. So all large steps stand in one function.
//
// The kernel brings segments/ray_sample.glsl, volume/volume_constant.glsl and volume/volume_integrators.glsl.

// Of a ray in this dispatch.
struct core_march {
    core_light light;
    core_held_piece held;
    // How long the next step may be.
    elvis_real step;
    // CORE_FLAG_...
    uint flags;
    uint work, n_elements;
    uint n_evaluations, n_mappings, n_segments, n_empty, n_steps, n_breakpoints, n_failures;
};

// What is known of the field along a segment.
struct core_findings {
    // It is constant; none of its values has been taken; it is no number; that, or not found.
    bool is_constant, is_fresh, is_no_number, is_broken;
};

// Up to where light of a segment is integrated; whether there was no time for the rest.
struct core_integrated {
    elvis_real until;
    bool is_left_open;
};

bool core_is_open(uint wants, core_findings findings) {
    return wants != CORE_WANTS_NOTHING && !findings.is_broken && !findings.is_constant;
}

bool core_is_taken(uint status, core_findings findings) {
    return status == CORE_SAMPLE_FOUND && !findings.is_broken && !findings.is_constant;
}

// Of the segment from `from` to `until`, of a walk that began at `start`.
core_accuracy core_accuracy_along(elvis_real speed, elvis_real start, elvis_real from, elvis_real until, const core_light light) {
    const elvis_real tolerance = elvis_real(core_tolerance);
    const elvis_real ahead = max(elvis_real(core_extent) / speed - (from - start), until - from);
#if CORE_HAS_JUMPS
    // How far the error of a value moves the place of a jump is not known: samples are as good as rounding lets them be.
    const elvis_real enough = elvis_real(0);
#else
    const elvis_real enough = elvis_real(0.0625LF) * max(tolerance - light.error, elvis_real(0.0625LF) * tolerance) /
                              (elvis_real(core_steepest) * (until - from) * speed * max(light.transmittance, elvis_real(1e-6LF)));
#endif
    return core_accuracy(speed, tolerance, ahead, enough);
}

// Whether an evaluation at an end of the segment of this length tells that one piece, in which nothing changes, holds all of it.
bool core_tells_constant(const core_ray_sample found, elvis_real span, elvis_real length, inout core_held_piece held) {
    if (abs(span) < length || !found.is_known || core_skips_by_range == 0u) {
        return false;
    }
    const elvis_real other = found.value + span * found.slope, beyond = found.bend + found.error;
    return core_is_constant(elvis_vec2(min(found.value, other) - beyond, max(found.value, other) + beyond), held);
}

// Light of a segment that needs no quadrature.
void core_add_simple(inout core_light light, core_findings findings, const core_held_piece held, elvis_real length) {
    if (findings.is_constant) {
        core_add_constant(light, core_piece_of(held), length);
    }
    // What is no number hides all behind it, in a colour of its own.
    if (findings.is_no_number) {
        core_add_light(light, elvis_vec3(1, 0, 1), elvis_real(0));
    }
}

// `has_segment`: whether anything lies between. `start`: where the walk began.
core_integrated core_add_segment(const core_traced_ray ray, const core_segment segment, elvis_real start, elvis_real from, elvis_real until,
                              bool has_segment, inout core_march march) {
    const bool is_bounded =
        core_is_constant(core_range_along(segment, from, until), march.held) && has_segment && core_skips_by_range != 0u;
    core_findings findings = core_findings(is_bounded, true, false, false);
    const core_accuracy wanted = core_accuracy_along(ray.speed, start, from, until, march.light);
    core_integral integral = core_integral_begin(from, has_segment && !is_bounded ? until : from, ray.speed, march.step);
    core_follower follower = core_follow_from(segment.anchor, core_point_before(segment));
    core_follow_to(follower, core_integral_at(integral), core_integral_span(integral), wanted.enough);
#if CORE_IS_EXACT
    // Where the ray leaves the mapping has been evaluated, and where it enters an element that it is followed in.
    bool is_predicted = core_is_open(integral.wants, findings), is_entry = false;
    while (is_predicted) {
        const core_ray_sample found = core_sample_predicted(segment, is_entry, follower.goal, follower.span, wanted.enough);
        march.n_evaluations += 1u;
        findings.is_constant = findings.is_fresh && core_tells_constant(found, follower.span, until - from, march.held);
        const bool is_taken = core_is_taken(found.status, findings);
        if (is_taken) {
            findings.is_fresh = false;
            core_integral_add(integral, march.light, found, wanted, march.held, march.work);
            core_follow_to(follower, core_integral_at(integral), core_integral_span(integral), wanted.enough);
        }
        is_predicted = CORE_REMEMBERS_ENTRY == 1 && is_taken && !is_entry && integral.wants == CORE_WANTS_LEFT &&
                       segment.entry_step < CORE_NO_STEP;
        is_entry = true;
        if (!is_predicted) {
            break;
        }
    }
#endif
    while (core_is_open(integral.wants, findings) && (march.work < CORE_WORK_LIMIT || !core_integral_may_stop(integral))) {
        // Until all lanes have what they need, so that what follows is done for all of them together.
        bool is_running = core_integral_wants_sample(integral);
        while (is_running) {
            const core_ray_sample found = core_sample_step(ray, segment.element, segment.curvature, follower);
            const bool has_failed = found.is_finite && found.status == CORE_SAMPLE_FAILED;
            findings.is_no_number = !found.is_finite;
            findings.is_broken = !found.is_finite || has_failed;
            march.flags |= !found.is_finite ? CORE_FLAG_NAN : has_failed ? CORE_FLAG_NEWTON_FAILURE : 0u;
            march.n_failures += has_failed ? 1u : 0u;
            march.n_evaluations += 1u;
            march.work += CORE_WORK_A_SAMPLE;
#if !CORE_IS_EXACT
            if (findings.is_fresh && !findings.is_broken) {
                findings.is_constant = core_tells_constant(found, follower.span, until - from, march.held);
            }
#endif
            if (core_is_taken(found.status, findings)) {
                findings.is_fresh = false;
                core_integral_add(integral, march.light, found, wanted, march.held, march.work);
                core_follow_to(follower, core_integral_at(integral), core_integral_span(integral), wanted.enough);
            }
            is_running = core_is_open(integral.wants, findings) && core_integral_wants_sample(integral) &&
                         (march.work < CORE_WORK_LIMIT || !core_integral_may_stop(integral));
            if (!is_running) {
                break;
            }
        }
        march.work = subgroupMax(march.work);
#if CORE_IS_EXACT
        if (core_is_open(integral.wants, findings)) {
            core_integrate_step(integral, march.light, wanted, march.held, march.work);
            core_follow_to(follower, core_integral_at(integral), core_integral_span(integral), wanted.enough);
        }
#endif
        if (!core_is_open(integral.wants, findings)) {
            break;
        }
    }
    core_add_simple(march.light, findings, march.held, (until - from) * ray.speed);
    march.flags |= has_segment && core_is_model_estimated(segment.element) ? CORE_FLAG_ESTIMATED : 0u;
    march.n_segments += has_segment ? 1u : 0u;
    march.n_empty += findings.is_constant ? 1u : 0u;
    march.n_steps += integral.n_steps;
    march.n_breakpoints += integral.n_breakpoints;
    const bool is_left_open = core_is_open(integral.wants, findings);
    march.step = is_left_open ? core_integral_step(integral) : CORE_FAR;
    return core_integrated(is_left_open ? core_integral_done(integral) : until, is_left_open);
}
