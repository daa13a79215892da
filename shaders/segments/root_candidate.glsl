// Where a polynomial on an interval of a ray may cross an isovalue, one place after the other: by Bernstein coefficients
// (segments/polynomial.glsl) or, with CORE_USES_COLLEAGUE, by eigenvalues (segments/colleague.glsl).

struct core_root_candidate {
    uint kind, index;
    // In the interval.
    elvis_real t, lower, upper;
};

#if CORE_USES_COLLEAGUE
// The first root that is an eigenvalue. If there is none: where the polynomial comes within E of an isovalue, no better than a touch.
core_root_candidate core_next_root_candidate(core_fit fit, core_polynomial bernstein, elvis_real error, inout core_isolation isolation) {
    core_root_candidate candidate = core_root_candidate(CORE_CROSSING_NONE, 0u, elvis_real(2), elvis_real(0), elvis_real(1));
    const bool is_over = core_isolation_is_over(isolation);
    const uint first = core_isovalue_from(core_least(bernstein) - error), end = core_isovalues_end(first, core_most(bernstein) + error);
    const uint n = is_over ? 0u : end - first;
    bool has_failed = false;
    uint n_solves = n;
    for (uint i = 0u; i < n_solves; ++i) {
        const uint index = first + i % n;
        const elvis_real shift = i < n ? elvis_real(0) : i < 2u * n ? -error : error;
        const core_colleague_root root = core_first_root_by_colleague(fit.chebyshev, CORE_REAL(core_isovalues, index) + shift, error);
        has_failed = has_failed || root.has_failed;
        const bool is_first = root.t < candidate.t;
        candidate.kind = is_first ? (i < n ? CORE_CROSSING_PROBABLE : CORE_CROSSING_TOUCH) : candidate.kind;
        candidate.index = is_first ? index : candidate.index;
        candidate.t = is_first ? root.t : candidate.t;
        n_solves = i + 1u == n && candidate.t > elvis_real(1) ? 3u * n : n_solves;
    }
    candidate.kind = has_failed ? CORE_CROSSING_TOUCH : candidate.kind;
    candidate.t = min(candidate.t, elvis_real(1));
    candidate.lower = max(candidate.t - elvis_real(1e-3LF), elvis_real(0));
    candidate.upper = min(candidate.t + elvis_real(1e-3LF), elvis_real(1));
    // There is no second one.
    core_isolation_next(isolation);
    return candidate;
}
#else
core_root_candidate core_next_root_candidate(core_fit fit, core_polynomial bernstein, elvis_real error, inout core_isolation isolation) {
    const core_crossing crossing = core_next_crossing(bernstein, error, core_n_isovalues, isolation);
    return core_root_candidate(crossing.kind, crossing.index, crossing.t, crossing.lower, crossing.upper);
}
#endif
