// A linear model of the shown field over each whole element, and its range (field/linear_model.glsl).

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "field/linear_model.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer core_output { float core_numbers[]; };
layout(push_constant) uniform core_parameters {
    uint core_first;
    uint core_n_elements;
    uint core_first_component;
    uint core_end_component;
};

#include "field/cube_model.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_elements) {
        return;
    }
    elvis_real reach;
    const core_model model =
        core_model_in_cube(core_first + i, CORE_CENTROID, elvis_vec3(0), elvis_real(1), elvis_real(0), CORE_EXTENT, reach);
    reach += model.remainder;
    const vec3 slope = vec3(model.slope);
    const float size = abs(float(model.value)) + abs(slope.x) + abs(slope.y) + abs(slope.z);
    // Single precision, whatever the kernel's.
    const float rounding = 16.0 * CORE_FLOAT_ROUNDOFF * (size + float(model.remainder)) + 1e-36;
    const bool is_known = core_model_is_known(model);
    const uint at = 8u * i;
    core_numbers[at] = float(model.value);
    core_numbers[at + 1u] = slope.x;
    core_numbers[at + 2u] = slope.y;
    core_numbers[at + 3u] = slope.z;
    core_numbers[at + 4u] = is_known ? float(model.remainder) + rounding : CORE_VALUE_UNKNOWN;
    core_numbers[at + 5u] = is_known ? float(model.value - reach) - rounding : -CORE_VALUE_UNKNOWN;
    core_numbers[at + 6u] = is_known ? float(model.value + reach) + rounding : CORE_VALUE_UNKNOWN;
    core_numbers[at + 7u] = core_is_model_estimated(core_first + i) ? 1.0 : 0.0;
}
