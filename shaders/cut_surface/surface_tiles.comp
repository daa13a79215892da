// For each tile of pixels, the nodes of a hierarchy that the tile's crossings with a surface can lie in: as cut_surface/cut_tiles.comp,
// but the box of the crossings comes from surface/hits.comp.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"

layout(std430, set = 0, binding = 0) readonly buffer core_boxes_block { float core_boxes[]; };
layout(std430, set = 0, binding = 1) writeonly buffer core_output { uint core_tiles[]; };

layout(push_constant) uniform core_constants {
    uint core_tiles_per_row;
    // Of the whole picture; and those that are wanted.
    uint core_n_tiles;
    uint core_first_tile, core_end_tile;
    // Work groups of surface/hits.comp in a tile, one below the other, each with a box.
    uint core_n_groups;
};

#define CORE_LISTED_BINDING 2
#define CORE_ON_PLANE 0
#include "tiles/list_nodes.glsl"

void main() {
    const uint tile = core_first_tile + gl_GlobalInvocationID.x;
    const bool is_wanted = tile < core_end_tile;
    const float infinite = 3e38;
    float low_x = infinite, low_y = infinite, low_z = infinite, high_x = -infinite, high_y = -infinite, high_z = -infinite;
    for (uint i = 0u; i < (is_wanted ? core_n_groups : 0u); ++i) {
        const uint group = ((tile / core_tiles_per_row) * core_n_groups + i) * core_tiles_per_row + tile % core_tiles_per_row;
        low_x = min(low_x, core_boxes[6u * group]);
        low_y = min(low_y, core_boxes[6u * group + 1u]);
        low_z = min(low_z, core_boxes[6u * group + 2u]);
        high_x = max(high_x, -core_boxes[6u * group + 3u]);
        high_y = max(high_y, -core_boxes[6u * group + 4u]);
        high_z = max(high_z, -core_boxes[6u * group + 5u]);
    }
    const vec3 lower = vec3(low_x, low_y, low_z), upper = vec3(high_x, high_y, high_z);
    core_list_nodes(tile, is_wanted, low_x <= high_x, lower, upper, core_n_tiles);
}
