// Smallest and largest of 7 x 7 x 7 samples of a field in each element, where that is: an estimate of its range, for plugins that give none. A few points
// in a dispatch, from the first on: drivers end loops that take many turns, those of an evaluation among them.

#include "library/expand.glsl"
#include "library/finite.glsl"

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) buffer core_output { elvis_real core_ranges[]; };
layout(push_constant) uniform core_parameters { uint core_first, core_n_elements, core_component, core_first_point, core_end_point; };

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_elements) {
        return;
    }
    const bool is_first = core_first_point == 0u;
    elvis_real lower = is_first ? elvis_real(3.0e38) : core_ranges[2u * index];
    elvis_real upper = is_first ? elvis_real(-3.0e38) : core_ranges[2u * index + 1u];
    for (uint node = core_first_point; node < core_end_point; ++node) {
        const elvis_vec3 step = elvis_vec3(node % 7u, (node / 7u) % 7u, node / 49u);
        const elvis_vec3 xi = core_expand(step / elvis_real(3) - elvis_vec3(1));
#ifdef CORE_SHOWN_BY_EXPRESSION
        const elvis_real value = core_shown_value(core_first + index, xi);
#else
        const elvis_real value = elvis_field_value(core_first + index, xi, core_component);
#endif
#if ELVIS_HAS_INSIDE
        elvis_real inside;
        elvis_vec3 slope;
        elvis_inside(core_first + index, xi, inside, slope);
        const bool is_finite = core_is_finite(value) && inside <= elvis_real(0);
#else
        const bool is_finite = core_is_finite(value);
#endif
        lower = is_finite ? min(lower, value) : lower;
        upper = is_finite ? max(upper, value) : upper;
    }
    core_ranges[2u * index] = lower;
    core_ranges[2u * index + 1u] = upper;
}
