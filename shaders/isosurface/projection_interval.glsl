// Projection: a polynomial along an interval of a segment, and where it may cross an isovalue.
//
// The kernel brings isosurface/projection_search.glsl.

// The polynomial is not believed if E is more than this share of how much it varies.
#if CORE_USES_COLLEAGUE
// Eigenvalues tell no error: as little as there can be.
#define CORE_ROUGH elvis_real(0)
#else
#define CORE_ROUGH elvis_real(1e-3LF)
#endif
// Below this share of the same, what differences of slopes say about E may be the gradient's own error.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_LEAST_SLOPE_ERROR elvis_real(1e-6LF)
#else
#define CORE_LEAST_SLOPE_ERROR elvis_real(1e-4LF)
#endif

// Takes a sample. Returns whether there are as many as a degree of the polynomial needs.
bool core_projection_add(core_ray_sample found, inout core_projection_search search) {
    core_add_sample(search.interval, found);
    core_want_sample(search);
    return core_fit_is_decision(search.interval.values);
}

// What the samples tell: no isovalue is taken, or the polynomial is good enough to look for where; else more samples, or half the interval.
void core_projection_judge(inout core_projection_search search) {
    search.fit = core_fit_of(search.interval.values);
    search.bernstein = core_to_bernstein(search.fit.chebyshev);
    search.floor_error = CORE_FIT_LEBESGUE * search.interval.values.sample_error + core_bernstein_rounding(search.fit.chebyshev);
    const elvis_real least = core_least(search.bernstein), most = core_most(search.bernstein);
    const elvis_real slope_error = core_slope_error(search.interval, search.bernstein, search.to - search.from);
    search.fit.error += slope_error > CORE_LEAST_SLOPE_ERROR * (most - least) + search.floor_error ? slope_error : elvis_real(0);
    // What is not rounding is an estimate.
    const elvis_real margin = elvis_real(2) * search.fit.error;
    const uint first = core_isovalue_from(least - margin);
    const bool is_free = first == core_isovalues_end(first, most + margin);
    const bool is_full = core_fit_is_full(search.interval.values);
    const bool is_crude = search.fit.error > elvis_real(0.25LF) * (most - least) + elvis_real(2) * search.floor_error;
    const bool is_rough = search.fit.error > CORE_ROUGH * (most - least) + elvis_real(2) * search.floor_error;
    const bool can_halve = search.interval.level < CORE_MOST_LEVELS && CORE_PLAIN == 0;
    const bool is_verified = is_free && !is_crude;
    const bool is_solved = !is_verified && (!is_rough || (is_full && !can_halve));
    const bool halves = !is_verified && !is_solved && is_full;
    search.n_verified += is_verified ? 1u : 0u;
    search.n_intervals += is_verified || is_solved ? 1u : 0u;
    search.n_degrees += is_verified || is_solved ? search.fit.degree : 0u;
#if CORE_PLAIN
    search.fit.error = core_bernstein_rounding(search.fit.chebyshev);
#endif
    search.isolation = core_isolation_begin();
    search.phase = is_verified ? CORE_PHASE_INTERVAL_DONE : is_solved ? CORE_PHASE_SOLVE : search.phase;
    if (halves) {
        core_projection_halve(search);
        core_want_sample(search);
    }
}

// The next candidate of the polynomial, to be polished.
void core_projection_solve(core_traced_ray traced_ray, inout core_projection_search search) {
    search.candidate = core_next_root_candidate(search.fit, search.bernstein, search.fit.error, search.isolation);
    const bool is_none = search.candidate.kind == CORE_CROSSING_NONE;
    // Where the polynomial is this near, the field may cross more than once; the slope tells.
    const elvis_real lower_value = core_bernstein_value(search.bernstein, search.candidate.lower);
    const elvis_real upper_value = core_bernstein_value(search.bernstein, search.candidate.upper);
    const bool is_uncertain = search.candidate.kind != CORE_CROSSING_VERIFIED && search.fit.error > elvis_real(2) * search.floor_error;
    const bool refines = !is_none && is_uncertain && CORE_PLAIN == 0;
    const bool is_full = core_fit_is_full(search.interval.values);
    const bool halves = refines && is_full && search.interval.level < CORE_MOST_LEVELS;
    search.isovalue = CORE_REAL(core_isovalues, search.candidate.index);
    search.rises = lower_value < upper_value;
    search.is_seen_below = search.is_seen_above = false;
    // Beside an interval's end the root of the field may be outside of the bracket.
    const bool is_verified = search.candidate.kind == CORE_CROSSING_VERIFIED;
    const elvis_real extent = search.to - search.from;
    const elvis_real margin = is_verified ? elvis_real(0) : elvis_real(2) * traced_ray.tolerance + elvis_real(1e-6LF) * extent;
    search.bracket_from = search.from + search.candidate.lower * extent - margin;
    search.bracket_to = search.from + search.candidate.upper * extent + margin;
    search.polish_iterations = 0u;
    search.last_step = CORE_FAR;
    core_follow_to(search.follower, search.from + search.candidate.t * extent, elvis_real(0), elvis_real(0));
    const bool is_ignored = CORE_PLAIN == 1 && search.candidate.kind == CORE_CROSSING_TOUCH;
    search.phase = is_none ? CORE_PHASE_INTERVAL_DONE : is_ignored ? CORE_PHASE_SOLVE : CORE_PHASE_POLISH;
    if (refines && (halves || !is_full)) {
        if (halves) {
            core_projection_halve(search);
        }
        search.phase = CORE_PHASE_SAMPLE;
        core_want_sample(search);
    }
}

// To the next interval of the segment. `nearest_end`: nothing need be looked at behind.
void core_projection_behind_interval(elvis_real nearest_end, inout core_projection_search search) {
    const bool is_last = core_is_last_interval(search.interval);
    if (!is_last) {
        core_next_interval(search.interval);
        search.from = search.to;
        const elvis_real share = elvis_real(search.interval.index + 1u) / elvis_real(1u << search.interval.level);
        search.to = search.segment_from + share * (search.segment_to - search.segment_from);
        core_want_sample(search);
    }
    search.phase = is_last ? CORE_PHASE_SEGMENT_DONE : search.from > nearest_end ? CORE_PHASE_SEEK : CORE_PHASE_SAMPLE;
}
