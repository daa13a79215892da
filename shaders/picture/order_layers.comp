// Swaps two transparent layers where the first is not the nearer one.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0, std430) buffer core_near_colors_block { elvis_vec4 core_near_colors[]; };
layout(set = 0, binding = 1, std430) buffer core_near_depths_block { elvis_real core_near_depths[]; };
layout(set = 0, binding = 2, std430) buffer core_far_colors_block { elvis_vec4 core_far_colors[]; };
layout(set = 0, binding = 3, std430) buffer core_far_depths_block { elvis_real core_far_depths[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const uint safe = min(pixel, core_n_pixels - 1u);
    const elvis_real near_depth = core_near_depths[safe], far_depth = core_far_depths[safe];
    if (pixel < core_n_pixels && far_depth < near_depth) {
        const elvis_vec4 near_color = core_near_colors[pixel];
        core_near_colors[pixel] = core_far_colors[pixel];
        core_far_colors[pixel] = near_color;
        core_near_depths[pixel] = far_depth;
        core_far_depths[pixel] = near_depth;
    }
}
