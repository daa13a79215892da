// From a row of core_bounds to what core_model_leaf takes.
//
// In pyramids, rows bound t times the second derivatives, t = (1 - xi_3)/2: they may grow without bound towards the apex. Around a point
// farther from it than `radius`, a region is away from the apex, and t falls to one half at most. Near the apex first derivatives bound
// how far a field may be from its tangent.

#ifndef CORE_LEAF_BOUNDS
#define CORE_LEAF_BOUNDS

// Rounding of a value, relative to the largest, and of a gradient: three times and twice what evaluations of orders up to 10 show.
#define CORE_VALUE_ROUNDING (elvis_real(24) * CORE_ROUNDOFF)
#define CORE_GRADIENT_ROUNDING (elvis_real(64) * CORE_ROUNDOFF)

// Of a point that is computed.
#define CORE_POINT_ROUNDING (elvis_real(4) * CORE_ROUNDOFF)

#if ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
// Whether the error of a linear model bounds second derivatives in its region.
#define CORE_ERRORS_TELL_BENDS false

bool core_is_away_from_apex(elvis_vec3 xi, elvis_real radius) { return radius <= elvis_real(0.5LF) * (elvis_real(1) - xi.z); }

elvis_vec3 core_leaf_bounds(elvis_vec4 row, elvis_vec3 xi, elvis_real radius) {
    const elvis_real t = elvis_real(0.5LF) * (elvis_real(1) - xi.z), least_radius = elvis_real(1e-30LF);
    const bool is_away = core_is_away_from_apex(xi, radius) && radius > least_radius;
    // |f(xi + d) - f(xi)| and |gradient . d| are L |d| at most.
    const elvis_real bend = is_away ? row.x / (t - elvis_real(0.5LF) * radius) : elvis_real(4) * row.y / max(radius, least_radius);
    const elvis_real of_point = is_away ? CORE_POINT_ROUNDING * row.x / t : elvis_real(0);
    return elvis_vec3(bend, CORE_VALUE_ROUNDING * row.z, CORE_GRADIENT_ROUNDING * row.y + of_point);
}
#else
#define CORE_ERRORS_TELL_BENDS true

bool core_is_away_from_apex(elvis_vec3 xi, elvis_real radius) { return true; }

elvis_vec3 core_leaf_bounds(elvis_vec4 row, elvis_vec3 xi, elvis_real radius) {
    return elvis_vec3(row.x, CORE_VALUE_ROUNDING * row.z, CORE_GRADIENT_ROUNDING * row.y);
}
#endif

#endif
