// A linear model of a field over a whole element, from its centroid, in single precision: what can be told of the field along a ray
// before anything is evaluated. From the host's buffer core_models: value, slope, remainder (arithmetic/model.glsl), and the range of
// the field, which the host chooses elements by; and whether a ray that passes the element by, on the word of these, is to be flagged,
// because they are estimates.

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
