// Light of a ray's segment: samples of the field, as the integrator wants them, and its integral of what lies between.
//
// Drivers compile a function's body once for each function around it. So the large ones, which evaluate, stand in the kernel's own loops;
// here is what lies between them.
//
// The kernel brings segments/ray_sample.glsl, volume/volume_constant.glsl and volume/volume_integrators.glsl.

struct core_march_counts {
    uint n_elements, n_evaluations, n_mappings, n_segments, n_empty, n_steps, n_breakpoints, n_failures;
};

// What is known of the field along a segment.
struct core_findings {
    // It is constant; none of its values has been taken; it is no number; that, or not found.
    bool is_constant, is_fresh, is_no_number, is_broken;
};

bool core_is_open(uint wants, core_findings findings) {
    return wants != CORE_WANTS_NOTHING && !findings.is_broken && !findings.is_constant;
}

// Of the segment from `from` to `until`, of a walk that began at `start`.
core_accuracy core_accuracy_along(elvis_real speed, elvis_real start, elvis_real from, elvis_real until, core_light light) {
    const elvis_real tolerance = elvis_real(core_tolerance);
    const elvis_real ahead = max(elvis_real(core_extent) / speed - (from - start), until - from);
    const elvis_real enough = elvis_real(0.0625LF) * max(tolerance - light.error, elvis_real(0.0625LF) * tolerance) /
                              (elvis_real(core_steepest) * (until - from) * speed * max(light.transmittance, elvis_real(1e-6LF)));
    return core_accuracy(speed, tolerance, ahead, enough);
}

// At the next sample.
void core_aim(core_integral integral, elvis_real enough, inout core_follower follower) {
    core_follow_to(follower, core_integral_at(integral));
    follower.span = core_integral_span(integral);
    follower.enough = enough;
}

// Whether an evaluation at an end of the segment of this length tells that one piece, in which nothing changes, holds all of it.
bool core_tells_constant(core_ray_sample found, elvis_real span, elvis_real length, inout core_held_piece held) {
    if (abs(span) < length || !found.is_known || core_skips_by_range == 0u) {
        return false;
    }
    const elvis_real other = found.value + span * found.slope, beyond = found.bend + found.error;
    return core_is_constant(elvis_vec2(min(found.value, other) - beyond, max(found.value, other) + beyond), held);
}

void core_judge(core_ray_sample found, inout core_findings findings, inout core_march_counts counts, inout uint flags) {
    const bool has_failed = found.is_finite && found.status == CORE_SAMPLE_FAILED;
    findings.is_no_number = !found.is_finite;
    findings.is_broken = !found.is_finite || has_failed;
    counts.n_evaluations += 1u;
    counts.n_failures += has_failed ? 1u : 0u;
    flags |= !found.is_finite ? CORE_FLAG_NAN : has_failed ? CORE_FLAG_NEWTON_FAILURE : 0u;
}

bool core_is_taken(uint status, core_findings findings) {
    return status == CORE_SAMPLE_FOUND && !findings.is_broken && !findings.is_constant;
}

// Light of a segment of this length that needed no quadrature: nothing changes in it, or what is no number hides all behind it, in a colour
// of its own.
void core_add_simple(inout core_light light, core_findings findings, core_held_piece held, elvis_real length) {
    if (findings.is_constant) {
        core_add_constant(light, core_piece_of(held), length);
    }
    if (findings.is_no_number) {
        core_add_light(light, elvis_vec3(1, 0, 1), elvis_real(0));
    }
}
