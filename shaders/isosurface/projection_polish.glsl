// Projection: from a candidate to the crossing of the field itself, by Newton's method along the ray in a bracket.
//
// The kernel brings isosurface/projection_search.glsl, isosurface/nearest_crossing.glsl and isosurface/isosurface_blur.glsl.

#define CORE_POLISH_ITERATIONS 40u
#define CORE_CANDIDATE_ITERATIONS 16u

// By the sample at t, at which the field is `off` the isovalue, within `error`.
void core_narrow_bracket(elvis_real t, elvis_real off, elvis_real error, inout core_projection_search search) {
    const bool is_above = off > error, is_below = off < -error;
    search.is_seen_above = search.is_seen_above || is_above;
    search.is_seen_below = search.is_seen_below || is_below;
    search.bracket_from = (search.rises ? is_below : is_above) ? max(search.bracket_from, t) : search.bracket_from;
    search.bracket_to = (search.rises ? is_above : is_below) ? min(search.bracket_to, t) : search.bracket_to;
}

// The root near the sample, as a crossing of the ray.
core_nearest_crossing core_polished(core_ray_sample found, core_projection_search search, elvis_real root_t, elvis_real half_width,
                                    elvis_real bend, bool is_surely_inside) {
    const core_frame frame = found.frame;
    const elvis_vec3 gradient = found.gradient.x * frame.row0 + found.gradient.y * frame.row1 + found.gradient.z * frame.row2;
    const elvis_vec3 point = found.xi + found.q + (root_t - search.follower.at) * found.w;
    const elvis_real inverse_square = dot(frame.row0, frame.row0) + dot(frame.row1, frame.row1) + dot(frame.row2, frame.row2);
    return core_nearest_crossing(root_t, half_width, found.slope > elvis_real(0), point.x, point.y, point.z, search.isovalue, gradient.x,
                                 gradient.y, gradient.z, inverse_square * bend / length(gradient), search.element,
                                 elvis_fetch_core_elements(search.element, 0u), is_surely_inside);
}

// A step of Newton's method from a sample at the follower's parameter; at the root the crossing is taken, or the candidate given up.
// `size`: of the volume, in the ray's parameter.
void core_projection_polish_or_take(core_ray ray, core_traced_ray traced_ray, elvis_real size, const core_last_crossing last,
                                    core_ray_sample found, inout core_projection_search search, inout core_nearest_crossing nearest) {
    search.polish_iterations += 1u;
    const elvis_real t = search.follower.at, off = found.value - search.isovalue;
    core_narrow_bracket(t, off, found.error, search);
    const elvis_real step = -off / found.slope, half_width = found.error / abs(found.slope);
    const elvis_real speed = core_max_norm(found.w);
    const bool is_regular = core_is_finite(step);
    const elvis_real next = t + step;
    const bool is_within = is_regular && next >= search.bracket_from && next <= search.bracket_to;
    // From here the line's root is as good as any.
    const bool is_at_root = is_regular && (abs(step) * speed <= elvis_real(4) * found.rounding ||
                                           // Steps are rounding of the field.
                                           (abs(step) <= half_width && abs(step) >= elvis_real(0.5LF) * search.last_step));
    search.last_step = is_regular ? abs(step) : CORE_FAR;
    const elvis_real farthest = max(abs(search.bracket_from), abs(search.bracket_to));
    const bool is_narrow = search.bracket_to - search.bracket_from <= elvis_real(4) * CORE_ROUNDOFF * farthest;
    const bool is_candidate = search.candidate.kind != CORE_CROSSING_VERIFIED;
    const bool is_last = search.polish_iterations >= (is_candidate ? CORE_CANDIDATE_ITERATIONS : CORE_POLISH_ITERATIONS);
    const bool is_settled = is_at_root || is_narrow || CORE_PLAIN == 1;
    const elvis_real root_t = is_at_root && CORE_PLAIN == 0 ? next : t;
    const elvis_real radius = core_max_norm(found.q) + found.beyond + speed * (half_width + abs(step));
    // Where the element's model does not bound second derivatives, they have a bound of their own around the sample, or are estimated.
    const elvis_real own_bend = CORE_ERRORS_TELL_BENDS ? search.bend : core_shown_bend(search.element, found.xi, radius);
    const bool is_bend_known = own_bend < CORE_UNKNOWN;
    const elvis_real bend_here =
        (is_bend_known ? own_bend : search.bend) + elvis_real(2) * search.curvature * core_model_norm1(found.gradient);
    const bool keeps_slope = found.is_known && speed * bend_here * radius < abs(found.slope);
    const bool is_confirmed = !is_candidate || keeps_slope || (search.is_seen_below && search.is_seen_above) || CORE_PLAIN == 1;
    const elvis_real slack = traced_ray.tolerance + elvis_real(0.25LF) * half_width;
    const elvis_real outside = max(search.segment_from - root_t, root_t - search.segment_to);
    const bool is_inside = outside <= slack;
    const bool is_surely_inside = root_t >= search.segment.enter + search.segment.enter_error + slack &&
                                  root_t <= search.segment.leave - search.segment.leave_error - slack;
    const core_nearest_crossing root = core_polished(found, search, root_t, half_width, bend_here, is_surely_inside);
    const bool is_last_again =
        core_is_last_again(last, root) || (search.segment_from <= last.t && core_is_last_in_element(last, root));
    const bool is_crossing = is_settled && is_confirmed && is_inside && !is_last_again;
    const bool is_hit = is_crossing && core_is_ahead(ray, root_t, half_width);
    search.flags |= is_crossing && core_is_ahead_doubtful(ray, root_t, half_width) ? CORE_FLAG_UNDECIDED_IN_FRONT : 0u;
    // The last step may be small by chance.
    const elvis_real blur = max(abs(step), CORE_ROOT_SHARE * half_width);
    const bool is_wide = CORE_PLAIN == 0 && blur > CORE_DEPTH_TOLERANCE * size, is_blurred = is_hit && is_wide;
    // What rounding alone may have led out of the segment may be in it.
    const bool is_led_out = is_wide && !is_inside && outside <= half_width;
    // Eigenvalues give the first root of an interval only: behind one that is no crossing, as the last round's found again, may be another.
    const bool may_hide_another = CORE_USES_COLLEAGUE == 1 && CORE_PLAIN == 0;
    const bool is_undecided = !is_hit && (is_settled ? !is_confirmed || is_led_out || may_hide_another : is_last);
    search.n_crossings += is_settled && is_confirmed ? 1u : 0u;
    search.n_undecided += is_undecided ? 1u : 0u;
    const elvis_real candidate_t = search.from + search.candidate.t * (search.to - search.from);
    search.undecided_t = is_undecided || is_blurred ? min(search.undecided_t, is_undecided ? candidate_t : root_t) : search.undecided_t;

    core_nearest_take(is_hit, root, nearest);
    const bool is_estimated = core_is_model_estimated(search.element) || search.segment.is_estimated || CORE_PLAIN == 1 || !is_bend_known;
    search.flags |= is_hit && is_estimated ? CORE_FLAG_ESTIMATED : 0u;
    search.phase = is_hit ? CORE_PHASE_SEEK : is_settled || is_last ? CORE_PHASE_SOLVE : CORE_PHASE_POLISH;
    core_follow_to(search.follower, is_within ? next : elvis_real(0.5LF) * (search.bracket_from + search.bracket_to),
                   elvis_real(0), elvis_real(0));
}
