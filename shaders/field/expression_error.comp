// How much rounding costs an expression: largest core_shown_error at 3 x 3 x 3 points of each of some elements.

#include "element/expand.glsl"
#include "arithmetic/finite.glsl"

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) writeonly buffer core_output { elvis_real core_errors[]; };
// Elements 0, core_stride, 2 core_stride ..
layout(push_constant) uniform core_parameters { uint core_n_sampled, core_stride; };

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_sampled) {
        return;
    }
    elvis_real largest = elvis_real(0);
    for (uint node = 0u; node < 27u; ++node) {
        const elvis_vec3 step = elvis_vec3(node % 3u, (node / 3u) % 3u, node / 9u);
        const elvis_vec3 eta = elvis_real(0.9LF) * (step - elvis_vec3(1));
        const elvis_real error = core_shown_error(index * core_stride, core_expand(eta));
        // Where it is not finite the value may not be, either.
        largest = core_is_finite(error) ? max(largest, error) : largest;
    }
    core_errors[index] = largest;
}
