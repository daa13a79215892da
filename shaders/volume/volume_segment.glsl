// Light of a ray's segment: samples of the field, as the integrator wants them, and its integral of what lies between.
//
// The kernel brings segments/ray_sample.glsl, volume/volume_constant.glsl and volume/volume_integrators.glsl.

// A ray in this dispatch.
struct core_march {
    core_walk walk;
    core_light light;
    core_held_piece held;
    // How long the next step may be.
    elvis_real step;
    uint work, n_elements;
    uint n_evaluations, n_mappings, n_segments, n_empty, n_steps, n_breakpoints, n_failures;
};

// A segment that is being integrated.
struct core_integration {
    elvis_real from, until;
    core_integral integral;
    core_follower follower;
    // The field is no number; that, or not found; none of its values has been taken; it is constant along the segment.
    bool is_no_number, is_broken, is_fresh, is_constant;
};

bool core_is_open(core_integration along) {
    return along.integral.wants != CORE_WANTS_NOTHING && !along.is_broken && !along.is_constant;
}

bool core_may_work(core_integration along, core_march march) {
    return march.work < CORE_WORK_LIMIT || !core_integral_may_stop(along.integral);
}

// At the next sample.
void core_aim(core_accuracy wanted, inout core_integration along) {
    core_follow_to(along.follower, core_integral_at(along.integral));
    along.follower.span = core_integral_span(along.integral);
    along.follower.enough = wanted.enough;
}

core_accuracy core_accuracy_along(core_traced_ray ray, elvis_real from, elvis_real until, core_march march) {
    const elvis_real tolerance = elvis_real(core_tolerance), speed = ray.speed;
    const elvis_real ahead = max(elvis_real(core_extent) / speed - (from - march.walk.start), until - from);
    const elvis_real enough = elvis_real(0.0625LF) * max(tolerance - march.light.error, elvis_real(0.0625LF) * tolerance) /
                              (elvis_real(core_steepest) * (until - from) * speed * max(march.light.transmittance, elvis_real(1e-6LF)));
    return core_accuracy(speed, tolerance, ahead, enough);
}

core_integration core_integration_begin(core_segment segment, elvis_real from, elvis_real until, bool is_empty, core_accuracy wanted,
                                        elvis_real step) {
    core_integration along;
    along.from = from;
    along.until = until;
    along.integral = core_integral_begin(from, is_empty ? from : until, wanted.per_parameter, step);
    along.follower = core_follow_from(segment.anchor);
    along.is_no_number = along.is_broken = along.is_constant = false;
    along.is_fresh = true;
    core_aim(wanted, along);
    return along;
}

// Whether an evaluation at an end of the segment tells that one piece, in which nothing changes, holds all of it.
void core_tell_constant(core_ray_sample found, inout core_integration along, inout core_march march) {
    const elvis_real span = along.follower.span;
    if (abs(span) >= along.until - along.from && found.is_known && core_skips_by_range != 0u) {
        const elvis_real other = found.value + span * found.slope, beyond = found.bend + found.error;
        along.is_constant = core_is_constant(elvis_vec2(min(found.value, other) - beyond, max(found.value, other) + beyond), march.held);
    }
}

// The sample that is wanted, if it is that, into the integral.
void core_take(core_ray_sample found, core_accuracy wanted, inout core_integration along, inout core_march march) {
    if (!along.is_broken && !along.is_constant && found.status == CORE_SAMPLE_FOUND) {
        along.is_fresh = false;
        core_integral_add(along.integral, march.light, found, wanted, march.held, march.work);
        core_aim(wanted, along);
    }
}

// Samples, until all lanes have what they need, so that what follows is done for all of them together.
void core_take_samples(core_traced_ray ray, core_segment segment, core_accuracy wanted, inout core_integration along,
                       inout core_march march) {
    bool is_running = core_integral_wants_sample(along.integral);
    while (is_running) {
        march.work += CORE_WORK_A_SAMPLE;
        march.n_evaluations += 1u;
        const core_ray_sample found = core_sample_step(ray, segment.element, segment.curvature, along.follower);
        const bool has_failed = found.is_finite && found.status == CORE_SAMPLE_FAILED;
        along.is_no_number = !found.is_finite;
        along.is_broken = along.is_no_number || has_failed;
        march.n_failures += has_failed ? 1u : 0u;
        march.walk.flags |= along.is_no_number ? CORE_FLAG_NAN : has_failed ? CORE_FLAG_NEWTON_FAILURE : 0u;
#if !CORE_IS_EXACT
        if (along.is_fresh && !along.is_broken) {
            core_tell_constant(found, along, march);
        }
#endif
        core_take(found, wanted, along, march);
        is_running = core_is_open(along) && core_integral_wants_sample(along.integral) && core_may_work(along, march);
        if (!is_running) {
            break;
        }
    }
    march.work = subgroupMax(march.work);
}

void core_integrate(core_traced_ray ray, core_segment segment, core_accuracy wanted, inout core_integration along, inout core_march march) {
#if CORE_IS_EXACT
    // Where the ray leaves the mapping has been evaluated.
    if (along.integral.wants != CORE_WANTS_NOTHING) {
        march.n_evaluations += 1u;
        const core_ray_sample found =
            core_sample_predicted(segment, core_integral_at(along.integral), along.follower.span, wanted.enough);
        core_tell_constant(found, along, march);
        core_take(found, wanted, along, march);
    }
#endif
    while (core_is_open(along) && core_may_work(along, march)) {
        core_take_samples(ray, segment, wanted, along, march);
#if CORE_IS_EXACT
        if (core_is_open(along)) {
            core_integrate_step(along.integral, march.light, wanted, march.held, march.work);
            core_aim(wanted, along);
        }
#endif
        if (!core_is_open(along)) {
            break;
        }
    }
}

// Light of what lies between; `has_segment`: whether anything does. True if there was no time for all of it: the ray goes on in the same
// element.
bool core_add_segment(core_traced_ray ray, core_segment segment, elvis_real from, elvis_real until, bool has_segment,
                      inout core_march march) {
    const elvis_real length = (until - from) * ray.speed;
    const elvis_vec2 range = core_range_along(segment, from, until);
    const bool is_bounded = core_is_constant(range, march.held) && has_segment && core_skips_by_range != 0u;
    if (is_bounded) {
        core_add_constant(march.light, core_piece_of(march.held), length);
    }
    const core_accuracy wanted = core_accuracy_along(ray, from, until, march);
    core_integration along = core_integration_begin(segment, from, until, !has_segment || is_bounded, wanted, march.step);
    core_integrate(ray, segment, wanted, along, march);
    if (along.is_constant) {
        core_add_constant(march.light, core_piece_of(march.held), length);
    }
    // What is no number hides all behind it, in a colour of its own.
    if (along.is_no_number) {
        core_add_light(march.light, elvis_vec3(1, 0, 1), elvis_real(0));
    }
    march.n_segments += has_segment ? 1u : 0u;
    march.n_empty += is_bounded || along.is_constant ? 1u : 0u;
    march.n_steps += along.integral.n_steps;
    march.n_breakpoints += along.integral.n_breakpoints;
    march.walk.flags |= has_segment && core_is_model_estimated(segment.element) ? CORE_FLAG_ESTIMATED : 0u;
    const bool is_left_open = core_is_open(along);
    march.step = is_left_open ? core_integral_step(along.integral) : CORE_FAR;
    march.walk.done = march.walk.needs_roughly ? march.walk.done
                                               : max(march.walk.done, is_left_open ? core_integral_done(along.integral) : until);
    return is_left_open;
}
