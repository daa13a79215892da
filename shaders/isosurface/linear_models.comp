// A linear model of the shown field over each whole element, and its range (isosurface/linear_model.glsl).

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "isosurface/linear_model.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer core_output { float core_numbers[]; };
layout(push_constant) uniform core_parameters {
    uint core_first;
    uint core_n_elements;
    uint core_first_component;
    uint core_end_component;
};

#include "element/shape_region.glsl"
#include "field/shown_model.glsl"

// From the centroid to a point of the shape near this one, or itself: all vertices are among those of the cube.
elvis_vec3 core_way_to(int x, int y, int z) {
    elvis_real px = elvis_real(x), py = elvis_real(y), pz = elvis_real(z);
    core_project(px, py, pz);
    return elvis_vec3(px, py, pz) - CORE_CENTROID;
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_elements) {
        return;
    }
    // Patches have four corners: vertices below and above, and the middles of four faces, which estimates look at, too.
    core_model model;
    elvis_real reach = elvis_real(0), remainder = elvis_real(0);
    for (int level = -1; level <= 1; ++level) {
        const int side = level == 0 ? 0 : 1;
        const core_region region =
            core_region(core_way_to(-1, -side, level), core_way_to(1, side, level), core_way_to(-side, 1, level),
                       core_way_to(side, -1, level), elvis_real(0), CORE_EXTENT);
        elvis_real value;
        model = core_shown_model(core_first + i, CORE_CENTROID, region, value);
        remainder = max(remainder, model.remainder);
        reach = max(reach, core_model_reach(model, region));
    }
    model.remainder = remainder;
    reach += remainder;
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
