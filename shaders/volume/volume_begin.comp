// Rays of all pixels before they have gone anywhere.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"
#include "volume/volume_state.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer core_states_block { core_volume_state core_states[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    float core_tolerance;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    core_volume_state state;
    state.done = -CORE_FAR;
    state.walk = state.step = CORE_FAR;
    state.start = -CORE_FAR;
    state.red = state.green = state.blue = state.error = elvis_real(0);
    state.left = elvis_real(1);
    state.start_element = state.element = CORE_NO_ELEMENT;
    state.status = CORE_RAY_SEEKS;
    state.flags = 0u;
    if (pixel < core_n_pixels) {
        core_states[pixel] = state;
    }
}
