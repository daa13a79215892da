// core_shown_model of expressions of which no bounds are known, such as those of gradients: linearized at xi, with a remainder from
// how far the corners of the region are from that. What rests on it is labelled "estimated".

// A quadratic form is largest at a corner of the region, or at most this much larger between them; smaller regions are closer to
// quadratic.
#define CORE_ESTIMATE_SAFETY elvis_real(3)
// What derivatives of high order lose, in units of roundoff of the values.
#define CORE_ESTIMATE_ROUNDING (elvis_real(256) * CORE_ROUNDOFF)

core_model core_shown_model(uint element, elvis_vec3 xi, core_region region, out elvis_real value) {
    elvis_vec3 slope;
    core_shown_gradient(element, xi, value, slope);
    elvis_real misfit = elvis_real(0), size = abs(value);
    bool is_known = core_is_finite(value) && core_is_finite(core_model_norm1(slope));
    for (uint i = 0u; i < 4u; ++i) {
        const elvis_vec3 corner = i == 0u ? region.corner0 : i == 1u ? region.corner1 : i == 2u ? region.corner2 : region.corner3;
        const elvis_real there = core_shown_value(element, xi + corner);
        misfit = max(misfit, abs(there - value - dot(slope, corner)));
        size = max(size, abs(there));
        is_known = is_known && core_is_finite(there);
    }
    return core_model_result(value, slope, CORE_ESTIMATE_SAFETY * misfit + CORE_ESTIMATE_ROUNDING * size, is_known, region);
}

bool core_is_model_estimated(uint element) { return true; }
