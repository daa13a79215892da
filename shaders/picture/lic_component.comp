// One component of the vectors at the points that pixels show, from where a pass has written it.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0, std430) readonly buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 1, std430) readonly buffer core_values_block { core_sample core_values[]; };
layout(set = 0, binding = 2, std430) writeonly buffer core_vectors_block { elvis_real core_vectors[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_component;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel < core_n_pixels && core_marks[pixel].owner != 0u) {
        core_vectors[3u * pixel + core_component] = core_values[pixel].value;
    }
}
