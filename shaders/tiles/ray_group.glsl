// Rays of pixels in groups: as many neighbours in a row of pixels as a tile is wide. The kernel brings CORE_GROUPS_BINDING.

layout(set = 0, binding = CORE_GROUPS_BINDING, std430) readonly buffer core_groups_block { uint core_groups[]; };

// Column and row of the invocation's pixel, in the work group's group; `first`: where in the list the dispatch begins. The column may be
// beyond the picture's width.
uvec2 core_group_pixel(uint first, uint width) {
    const uint group = core_groups[first + gl_WorkGroupID.x], tiles_per_row = (width + CORE_TILE_WIDTH - 1u) / CORE_TILE_WIDTH;
    return uvec2(group % tiles_per_row * CORE_TILE_WIDTH + gl_LocalInvocationID.x, group / tiles_per_row);
}
