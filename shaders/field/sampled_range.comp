// Smallest and largest of 7 x 7 x 7 samples of a field in boxes of collapsed coordinates, each in one element, and which samples they
// are. A few samples in a dispatch, from the first on: drivers end loops that take many iterations, those of an evaluation among them.

#include "element/expand.glsl"
#include "arithmetic/finite.glsl"

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) buffer core_output { elvis_real core_ranges[]; };
layout(set = 0, binding = 1, std430) buffer core_output_samples { uint core_samples[]; };
// Of each box the element, its middle and half of its width.
layout(set = 0, binding = 2, std430) readonly buffer core_input_elements { uint core_box_elements[]; };
layout(set = 0, binding = 3, std430) readonly buffer core_input_boxes { elvis_real core_boxes[]; };
// Several components: the magnitude.
layout(push_constant) uniform core_parameters { uint core_n_boxes, core_component, core_n_components, core_first_sample, core_end_sample; };

elvis_real core_sampled_value(uint element, elvis_vec3 xi) {
#ifdef CORE_SHOWN_BY_EXPRESSION
    return core_shown_value(element, xi);
#else
    if (core_n_components == 1u) {
        return elvis_field_value(element, xi, core_component);
    }
    elvis_real sum = elvis_real(0);
    for (uint component = 0u; component < core_n_components; ++component) {
        const elvis_real value = elvis_field_value(element, xi, component);
        sum += value * value;
    }
    return sqrt(sum);
#endif
}

// Cut elements have values where they are.
bool core_is_sample(uint element, elvis_vec3 xi, elvis_real value) {
#if ELVIS_HAS_INSIDE
    elvis_real inside;
    elvis_vec3 slope;
    elvis_inside(element, xi, inside, slope);
    return core_is_finite(value) && inside <= elvis_real(0);
#else
    return core_is_finite(value);
#endif
}

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_boxes) {
        return;
    }
    const bool is_first = core_first_sample == 0u;
    elvis_real lower = is_first ? elvis_real(3.0e38) : core_ranges[2u * index];
    elvis_real upper = is_first ? elvis_real(-3.0e38) : core_ranges[2u * index + 1u];
    uint lowest = is_first ? 0u : core_samples[2u * index];
    uint highest = is_first ? 0u : core_samples[2u * index + 1u];
    const uint element = core_box_elements[index];
    const elvis_vec3 middle = elvis_vec3(core_boxes[4u * index], core_boxes[4u * index + 1u], core_boxes[4u * index + 2u]);
    const elvis_real half_width = core_boxes[4u * index + 3u];
    for (uint node = core_first_sample; node < core_end_sample; ++node) {
        const elvis_vec3 step = elvis_vec3(node % 7u, (node / 7u) % 7u, node / 49u);
        const elvis_vec3 eta = middle + half_width * (step / elvis_real(3) - elvis_vec3(1));
        const elvis_vec3 xi = core_expand(clamp(eta, elvis_vec3(-1), elvis_vec3(1)));
        const elvis_real value = core_sampled_value(element, xi);
        if (core_is_sample(element, xi, value)) {
            lowest = value < lower ? node : lowest;
            highest = value > upper ? node : highest;
            lower = min(lower, value);
            upper = max(upper, value);
        }
    }
    core_ranges[2u * index] = lower;
    core_ranges[2u * index + 1u] = upper;
    core_samples[2u * index] = lowest;
    core_samples[2u * index + 1u] = highest;
}
