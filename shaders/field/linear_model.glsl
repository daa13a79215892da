// A linear model of a field over a whole element, from its centroid, in single precision: what can be told of the field along a ray
// before anything is evaluated. From the host's buffer core_models: value, slope, remainder (arithmetic/model.glsl); the field's range, by
// which the host selects elements; and whether the bounds are estimates, so that rays that skip the element are flagged.

#define CORE_VALUE_UNKNOWN 3e38

struct core_linear_model {
    float value;
    vec3 slope;
    float remainder;
    bool is_estimated;
};

#ifdef elvis_fetch4_core_models
core_linear_model core_fetch_linear_model(uint element) {
    const uvec4 first = elvis_fetch4_core_models(element, 0u), second = elvis_fetch4_core_models(element, 1u);
    return core_linear_model(uintBitsToFloat(first.x), uintBitsToFloat(first.yzw), uintBitsToFloat(second.x), second.w != 0u);
}
#endif
