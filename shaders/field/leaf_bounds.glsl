// From a row of core_bounds to what core_model_leaf takes.

#ifndef CORE_LEAF_BOUNDS
#define CORE_LEAF_BOUNDS

// Rounding of a value, relative to the largest, and of a gradient: twice what evaluations of orders up to 10 show.
#define CORE_VALUE_ROUNDING (elvis_real(16) * CORE_ROUNDOFF)
#define CORE_GRADIENT_ROUNDING (elvis_real(64) * CORE_ROUNDOFF)

elvis_vec3 core_leaf_bounds(elvis_vec4 row) {
    return elvis_vec3(row.x, CORE_VALUE_ROUNDING * row.z, CORE_GRADIENT_ROUNDING * row.y);
}

#endif
