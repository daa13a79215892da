// Lists the pixels of which it is not decided what lines they meet, and that elements of one class can have to do with.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"
#include "tiles/node_tiles.glsl"

layout(set = 0, binding = 0) CORE_READ_MARKS(core_marks);
layout(set = 0, binding = 1) CORE_READ_WORDS(core_tiles);
layout(set = 0, binding = 2, std430) writeonly buffer core_list_block { uint core_list[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_width;
    uint core_tiles_per_row;
};

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const uint safe = min(pixel, core_n_pixels - 1u);
    const uint column = safe % core_width, row = safe / core_width;
    const uint tile = row / CORE_TILE_HEIGHT * core_tiles_per_row + column / CORE_TILE_WIDTH;
    const bool is_open = (CORE_MARK(core_marks, safe).owner & CORE_OWNER_SETTLED) == 0u;
    const bool is_listed = pixel < core_n_pixels && is_open && CORE_WORD(core_tiles, tile * CORE_TILE_STRIDE) > 0u;
    const uint n_listed = subgroupAdd(is_listed ? 1u : 0u);
    uint first = 0u;
    if (n_listed > 0u && subgroupElect()) {
        first = atomicAdd(core_counts[0], n_listed);
    }
    first = subgroupBroadcastFirst(first);
    const uint before = subgroupExclusiveAdd(is_listed ? 1u : 0u);
    if (is_listed) {
        core_list[first + before] = pixel;
    }
}
