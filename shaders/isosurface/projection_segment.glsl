// Projection: the segments of a ray in an element.
//
// The kernel brings isosurface/projection_search.glsl, field/linear_model.glsl and isosurface/value_span.glsl.

// Segments of a ray in one element.
#define CORE_MOST_SEGMENTS 16u
// Times the tolerance of ends that a ray may be in an element within rounding without a flag.
#define CORE_LONGEST_TOUCH elvis_real(16)

#if ELVIS_REAL_IS_DOUBLE
#define CORE_BEGINNINGS_ARE_UNCERTAIN false
#else
#define CORE_BEGINNINGS_ARE_UNCERTAIN true
#endif

// Starts with an element, of which the ray meets the box in `span`.
void core_projection_element(core_ray ray, core_traced_ray traced_ray, uint element, vec2 span, inout core_projection_search search) {
    search.element = element;
    const core_linearization linearization = core_fetch_linearization(search.element);
    const vec3 target = vec3(core_reference.xyz - elvis_origin(search.element) + ray.origin);
    const vec3 start = core_linear_inverse(linearization, target);
    const vec3 motion = core_linear_inverse(linearization, target + vec3(ray.direction)) - start;
    const bool is_linearized = linearization.exponents != 0u;
    search.curvature = CORE_SEGMENT_CURVATURE(search.element);
    const core_linear_model model = core_fetch_linear_model(search.element);
    const vec2 inside = core_linear_span(start, motion, float(search.curvature), span);
    const vec2 open = core_value_span(model, start, motion, float(search.curvature), inside);
    const bool is_missed = is_linearized && inside.x > inside.y;
    const bool is_excluded = is_linearized && !is_missed && open.x > open.y;
    search.n_certified += is_excluded && !model.is_estimated ? 1u : 0u;
    search.flags |= is_excluded && model.is_estimated ? CORE_FLAG_ESTIMATED : 0u;
#if !CORE_PLAIN
    span = is_linearized ? open : span;
#endif
    search.bend = elvis_real(2) * elvis_real(model.remainder) / (CORE_EXTENT * CORE_EXTENT);
    search.span_end = elvis_real(span.y);
    search.n_segments = 0u;
    const elvis_real span_from = elvis_real(span.x), reach_end = min(search.span_end, span_from + traced_ray.longest);
    const bool is_begun =
        !is_missed && !is_excluded && core_segment_begin(traced_ray, search.element, span_from, reach_end, false, search.segment);
    search.sought_from = search.segment.begin;
    search.segment_from = CORE_FAR;
    search.phase = is_begun ? CORE_PHASE_CLIP : CORE_PHASE_SEEK;
}

// Leaves the stretch behind in which the ray may be in the element. Shorter ones are near the ends of what the neighbours have.
void core_projection_pass(bool is_passed, core_traced_ray traced_ray, inout core_projection_search search) {
    const bool is_long = search.segment_from < CORE_FAR &&
                         search.segment_to - search.segment_from > CORE_LONGEST_TOUCH * traced_ray.tolerance && CORE_PLAIN == 0;
    search.undecided_t = is_passed && is_long ? min(search.undecided_t, search.segment_from) : search.undecided_t;
}

// Notes what has been left out because rounding decides whether the ray is in the element: it runs along a face.
void core_projection_touch(core_traced_ray traced_ray, inout core_projection_search search) {
    const core_segment segment = search.segment;
    const bool is_touching = segment.is_touched && segment.enter_error > traced_ray.tolerance;
    // An earlier stretch, from which the ray has been out of the element since.
    const bool is_apart = is_touching && segment.enter > search.segment_to + traced_ray.tolerance;
    core_projection_pass(is_apart, traced_ray, search);
    search.segment_from = is_apart ? segment.enter : is_touching ? min(search.segment_from, segment.enter) : search.segment_from;
    search.segment_to = is_touching ? segment.enter + segment.enter_error : search.segment_to;
}

// An iteration towards the next segment.
void core_projection_segment(core_ray ray, core_traced_ray traced_ray, inout core_projection_search search) {
    const uint ending = core_segment_iterate(traced_ray, search.segment.element, search.segment);
    search.n_evaluations += 1u;
    core_projection_touch(traced_ray, search);
    const bool is_found = ending == CORE_SEGMENT_FOUND && search.segment.enter < search.segment.leave;
    const bool is_lost = ending != CORE_SEGMENT_OPEN && search.segment.has_failed;
    search.n_failures += is_lost ? 1u : 0u;
    search.undecided_t = is_lost ? min(search.undecided_t, search.segment.begin) : search.undecided_t;
    // A segment may have been missed. In single precision its beginning may be missing as well: rounding takes many iterations.
    const bool is_found_late = ending == CORE_SEGMENT_FOUND && CORE_BEGINNINGS_ARE_UNCERTAIN;
    const bool is_uncertain = (ending == CORE_SEGMENT_NONE || is_found_late) && search.segment.is_estimated && CORE_PLAIN == 0;
    search.undecided_t = is_uncertain ? min(search.undecided_t, search.sought_from) : search.undecided_t;
    search.phase = is_found ? CORE_PHASE_SAMPLE : ending == CORE_SEGMENT_OPEN ? CORE_PHASE_CLIP : CORE_PHASE_SEGMENT_DONE;
    // Ends are as wrong as that, and a crossing beside them is one all the same; but none is behind the eye.
    const elvis_real enter = search.segment.enter - search.segment.enter_error - traced_ray.tolerance;
    const bool is_over = ending != CORE_SEGMENT_OPEN, is_touched = search.segment_from < CORE_FAR;
    const bool is_joined = is_found && is_touched && enter <= search.segment_to + traced_ray.tolerance;
    core_projection_pass(is_over && !is_joined, traced_ray, search);
    search.segment_from = is_over ? max(is_joined ? search.segment_from : enter, ray.least_t) : search.segment_from;
    search.segment_to = is_over ? search.segment.leave + search.segment.leave_error + traced_ray.tolerance : search.segment_to;
    search.interval.level = search.interval.index = 0u;
    search.from = search.segment_from;
    search.to = search.segment_to;
    search.interval.values = search.interval.slopes = core_fit_begin();
    search.follower = core_follow_from(search.segment.anchor, search.segment.anchor);
    core_follow_to(search.follower, search.from, elvis_real(0), elvis_real(0));
}

// Behind a segment: on in the element, or to the next one. `nearest_end`: nothing need be looked at behind.
void core_projection_behind_segment(core_traced_ray traced_ray, elvis_real nearest_end, inout core_projection_search search) {
    search.n_segments += 1u;
    const elvis_real resume = search.segment.resume + traced_ray.tolerance;
    const bool goes_on = search.segment.is_inside && resume < search.span_end && resume < nearest_end;
    search.undecided_t = goes_on && search.n_segments >= CORE_MOST_SEGMENTS ? min(search.undecided_t, resume) : search.undecided_t;
    bool is_begun = false;
    if (goes_on && search.n_segments < CORE_MOST_SEGMENTS) {
        is_begun = core_segment_begin(traced_ray, search.element, resume, search.span_end, false, search.segment);
        search.sought_from = search.segment.begin;
        search.segment_from = CORE_FAR;
    }
    search.phase = is_begun ? CORE_PHASE_CLIP : CORE_PHASE_SEEK;
}
