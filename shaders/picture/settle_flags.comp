// Flags of pixels as callers know them (core/scene/buffers.md), and how many pixels have each.
//
// An invocation has CORE_PIXELS_EACH pixels, a work group apart: sums of many pixels take few atomic additions.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer core_marks_block { core_mark core_marks[]; };
// The same, as they are before.
layout(set = 0, binding = 2) CORE_READ_MARKS(core_old_marks);
// Pixels with each bit of the flags; behind them, pixels that show a surface.
layout(set = 0, binding = 1, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
};

#define CORE_N_FLAGS 16u

uint core_settled(uint flags) {
    // The upper half: of surfaces that are not seen there (picture/merge.comp).
    return core_settled_lines((flags | flags >> CORE_N_FLAGS) & CORE_PICTURE_FLAGS);
}

void core_add(uint index, uint n_met) {
    const uint n = subgroupAdd(n_met);
    if (n > 0u && subgroupElect()) {
        atomicAdd(core_counts[index], n);
    }
}

void main() {
    const uint item = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x, lane = item % CORE_GROUP_SIZE;
    const uint first = (item - lane) * CORE_PIXELS_EACH + lane;
    uint flags[CORE_PIXELS_EACH];
    uint met = 0u, changed = 0u, n_hits = 0u;
    for (uint i = 0u; i < CORE_PIXELS_EACH; ++i) {
        const uint pixel = first + i * CORE_GROUP_SIZE;
        core_mark mark = CORE_MARK(core_old_marks, min(pixel, core_n_pixels - 1u));
        if (pixel >= core_n_pixels) {
            mark = core_mark(0u, 0u);
        }
        flags[i] = core_settled(mark.flags);
        changed |= (flags[i] != mark.flags ? 1u : 0u) << i;
        met |= flags[i];
        n_hits += mark.owner >> CORE_OWNER_BITS != 0u ? 1u : 0u;
    }
    while (changed != 0u) {
        const uint i = uint(findLSB(changed));
        core_marks[first + i * CORE_GROUP_SIZE].flags = flags[i];
        changed &= changed - 1u;
    }
    core_add(CORE_N_FLAGS, n_hits);
    uint left = subgroupOr(met);
    while (left != 0u) {
        const uint bit = uint(findLSB(left));
        uint n = 0u;
        for (uint i = 0u; i < CORE_PIXELS_EACH; ++i) {
            n += flags[i] >> bit & 1u;
        }
        core_add(bit, n);
        left &= left - 1u;
    }
}
