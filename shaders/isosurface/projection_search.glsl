// The state of projection (isosurface/isosurface_projection.comp) along a ray: the element, the segment, the dyadic interval of that,
// and the candidate for a crossing.
//
// The kernel brings segments/segment.glsl, segments/ray_sample.glsl, segments/root_candidate.glsl and segments/dyadic_interval.glsl.

// What is next: an element, the segment, a sample of an interval, a candidate, a step towards its crossing.
#define CORE_PHASE_SEEK 0u
#define CORE_PHASE_CLIP 1u
#define CORE_PHASE_SAMPLE 2u
#define CORE_PHASE_SOLVE 3u
#define CORE_PHASE_POLISH 4u
// An interval, a segment or an element is done with.
#define CORE_PHASE_INTERVAL_DONE 5u
#define CORE_PHASE_SEGMENT_DONE 6u

struct core_projection_search {
    uint phase, flags;

    uint element;
    // Bounds of the mapping's curvature and of the field's second derivatives in it.
    elvis_real curvature, bend;
    // Where it ends at the latest; from where on the segment is looked for; segments so far.
    elvis_real span_end, sought_from;
    uint n_segments;
    core_segment segment;
    // The segment, as much longer as its ends may be wrong. While it is looked for, where the ray may be in the element within rounding;
    // from CORE_FAR on: nowhere.
    elvis_real segment_from, segment_to;

    core_dyadic_interval interval;
    elvis_real from, to;
    core_follower follower;
    // Its polynomial, and what error rounding alone leaves.
    core_fit fit;
    core_polynomial bernstein;
    elvis_real floor_error;

    core_isolation isolation;
    core_root_candidate candidate;
    elvis_real isovalue;
    // Holds the crossing; whether the field rises in it.
    elvis_real bracket_from, bracket_to;
    bool rises, is_seen_below, is_seen_above;
    uint polish_iterations;
    elvis_real last_step;

    // The nearest place that is undecided.
    elvis_real undecided_t;
    uint n_evaluations, n_certified, n_verified, n_undecided, n_crossings, n_failures, n_intervals, n_degrees;
};

core_projection_search core_projection_begin() {
    core_projection_search search;
    search.phase = CORE_PHASE_SEEK;
    search.flags = search.element = search.n_segments = 0u;
    search.curvature = search.span_end = search.sought_from = elvis_real(0);
    search.bend = CORE_FAR;
    search.segment.element = 0u;
    search.segment.resume = search.segment.last = elvis_real(0);
    search.segment_from = search.segment_to = search.from = search.to = elvis_real(0);
    search.interval.values = search.interval.slopes = core_fit_begin();
    search.interval.level = search.interval.index = 0u;
    search.bernstein = core_polynomial_zero();
    search.fit = core_fit(search.bernstein, elvis_real(0), 0u);
    search.floor_error = elvis_real(0);
    search.isolation = core_isolation_begin();
    search.candidate = core_root_candidate(CORE_CROSSING_NONE, 0u, elvis_real(0), elvis_real(0), elvis_real(0));
    search.isovalue = search.bracket_from = search.bracket_to = elvis_real(0);
    search.rises = search.is_seen_below = search.is_seen_above = false;
    search.polish_iterations = 0u;
    search.last_step = search.undecided_t = CORE_FAR;
    search.n_evaluations = search.n_certified = search.n_verified = search.n_undecided = 0u;
    search.n_crossings = search.n_failures = search.n_intervals = search.n_degrees = 0u;
    return search;
}

// The next sample that the interval's polynomial needs.
void core_want_sample(inout core_projection_search search) {
    core_follow_to(search.follower, search.from + core_fit_parameter(search.interval.values) * (search.to - search.from),
                   elvis_real(0), elvis_real(0));
}

// To the first half of the interval.
void core_projection_halve(inout core_projection_search search) {
    core_halve(search.interval);
    search.to = elvis_real(0.5LF) * (search.from + search.to);
}

// One evaluation, for what the search is at.
core_ray_sample core_projection_sample(core_traced_ray ray, inout core_projection_search search) {
    core_ray_sample found = core_sample_step(ray, search.element, search.curvature, search.follower);
    search.n_evaluations += 1u;
    const bool is_lost = !found.is_finite || found.status == CORE_SAMPLE_FAILED;
    search.n_failures += is_lost && found.is_finite ? 1u : 0u;
    search.flags |= !found.is_finite ? CORE_FLAG_NAN : 0u;
    search.undecided_t = is_lost && found.is_finite ? min(search.undecided_t, search.from) : search.undecided_t;
    search.phase = is_lost ? CORE_PHASE_SEGMENT_DONE : search.phase;
    return found;
}
