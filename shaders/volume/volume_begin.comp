// Rays of all pixels before they have gone anywhere.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"
#include "volume/volume_state.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer core_states_block { core_volume_state core_states[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    float core_tolerance;
    // What colours are off because they have few breakpoints.
    float core_color_error;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const core_walk_state walk =
        core_walk_state(-CORE_FAR, CORE_FAR, -CORE_FAR, CORE_NO_ELEMENT, CORE_NO_ELEMENT, CORE_RAY_SEEKS, 0u);
    const elvis_real none = elvis_real(0);
    if (pixel < core_n_pixels) {
        core_states[pixel] = core_volume_state(walk, CORE_FAR, core_light(none, none, none, elvis_real(1), elvis_real(core_color_error), none));
    }
}
