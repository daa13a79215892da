// Lists the pixels that carry one of some flags, and takes back what they show. With CORE_FILLS_MASK each pixel is told, too, whether it is
// listed.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_list_block { uint core_list[]; };
layout(set = 0, binding = 2, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    // All pixels, if zero.
    uint core_wanted_flags;
    // These stay.
    uint core_kept_flags;
};
#if CORE_FILLS_MASK
layout(set = 0, binding = 3, std430) writeonly buffer core_mask_block { uint core_mask[]; };
#endif

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const uint safe = min(pixel, core_n_pixels - 1u);
    const bool is_wanted = core_wanted_flags == 0u || (core_marks[safe].flags & core_wanted_flags) != 0u;
    const bool is_listed = pixel < core_n_pixels && is_wanted;
    const uint n_listed = subgroupAdd(is_listed ? 1u : 0u);
    uint first = 0u;
    if (n_listed > 0u && subgroupElect()) {
        first = atomicAdd(core_counts[0], n_listed);
    }
    first = subgroupBroadcastFirst(first);
    const uint before = subgroupExclusiveAdd(is_listed ? 1u : 0u);
    if (is_listed) {
        core_list[first + before] = pixel;
        core_marks[pixel] = core_mark(0u, core_marks[pixel].flags & core_kept_flags);
    }
#if CORE_FILLS_MASK
    if (pixel < core_n_pixels) {
        core_mask[pixel] = is_listed ? 1u : 0u;
    }
#endif
}
