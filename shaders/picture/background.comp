// A picture that shows nothing as yet.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer core_colors_block { elvis_vec4 core_colors[]; };
layout(set = 0, binding = 1, std430) readonly buffer core_background_block { elvis_vec4 core_background; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel < core_n_pixels) {
        core_colors[pixel] = core_background;
    }
}
