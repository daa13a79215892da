// Flags of pixels as callers know them (core/scene/buffers.md), and how many pixels have each.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0, std430) buffer core_marks_block { core_mark core_marks[]; };
// Pixels with each bit of the flags; behind them, pixels that show a surface.
layout(set = 0, binding = 1, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
};

#define CORE_N_FLAGS 16u

uint core_settled(uint flags) {
    // The upper half: of surfaces that are not seen there (picture/merge.comp).
    flags = (flags | flags >> CORE_N_FLAGS) & CORE_PICTURE_FLAGS;
    // One element may decide what another leaves open.
    flags &= (flags & CORE_FLAG_CONTOUR) != 0u ? ~CORE_FLAG_CONTOUR_UNDECIDED : 0xffffu;
    return flags & ((flags & CORE_FLAG_MESH_LINE) != 0u ? ~CORE_FLAG_MESH_UNDECIDED : 0xffffu);
}

void core_add(uint index, bool is_met) {
    const uint n = subgroupAdd(is_met ? 1u : 0u);
    if (n > 0u && subgroupElect()) {
        atomicAdd(core_counts[index], n);
    }
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    core_mark mark = core_mark(0u, 0u);
    if (pixel < core_n_pixels) {
        mark = core_marks[pixel];
    }
    const uint flags = core_settled(mark.flags);
    if (flags != mark.flags) {
        core_marks[pixel].flags = flags;
    }
    core_add(CORE_N_FLAGS, mark.owner >> CORE_OWNER_BITS != 0u);
    uint left = subgroupOr(flags);
    while (left != 0u) {
        const uint bit = uint(findLSB(left));
        core_add(bit, (flags >> bit & 1u) != 0u);
        left &= left - 1u;
    }
}
