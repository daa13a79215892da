// Rays of pixels in groups: as many as a tile is wide, in rectangles that are CORE_GROUP_WIDTH wide. Rays that are close together go
// through the same elements, and need as many steps.

uvec2 core_pixel_in_group(uint group, uint lane, uint width) {
    const uint groups_a_row = (width + CORE_GROUP_WIDTH - 1u) / CORE_GROUP_WIDTH;
    return uvec2(group % groups_a_row, group / groups_a_row) * uvec2(CORE_GROUP_WIDTH, CORE_TILE_WIDTH / CORE_GROUP_WIDTH) +
           uvec2(lane % CORE_GROUP_WIDTH, lane / CORE_GROUP_WIDTH);
}
