// Which pixels show a surface, without its flags: where a pass is to evaluate another field.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0, std430) readonly buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_copies_block { core_mark core_copies[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel < core_n_pixels) {
        core_copies[pixel] = core_mark(core_marks[pixel].owner, 0u);
    }
}
