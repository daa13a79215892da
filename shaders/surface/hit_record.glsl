// Where a pixel's ray meets the surface, between kernels.

struct core_hit_record {
    // CORE_FAR: no crossing, and none behind.
    elvis_real t;
    // Bound of t's rounding error.
    elvis_real error;
};
