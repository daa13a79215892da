// For each tile of pixels, the nodes of a hierarchy that touch a box: neighbouring pixels share most of their way through the hierarchy, so
// it is gone once for all of them.
//
// The kernel brings core_tiles, CORE_LISTED_BINDING, and CORE_ON_PLANE: 1 for a cut plane, 0 for other surfaces.

#include "tiles/hierarchy.glsl"
#include "tiles/node_tiles.glsl"
#include "arithmetic/driver_limit.glsl"
#include "tiles/list_tile.glsl"

#if CORE_ON_PLANE
#include "cut_surface/meets_plane.glsl"
#define core_may_hold(node) core_meets_plane(node)
#else
#define core_may_hold(node) true
#endif

// `is_seen`: there is a box, from `lower` to `upper`; without one the list is empty. `n_tiles`: of the whole picture.
void core_list_nodes(uint tile, bool is_wanted, bool is_seen, vec3 lower, vec3 upper, uint n_tiles) {
    uint stack[CORE_STACK_SIZE];
    uint stack_size = is_wanted && is_seen ? 1u : 0u;
    stack[0] = 0u;
    uint n_entries = 0u;
    const uint first = tile * CORE_TILE_STRIDE + 1u;
    while (stack_size > 0u) {
        stack_size -= 1u;
        const uint index = stack[stack_size];
        const core_node node = core_fetch_node(index);
        const bool is_touched = core_overlaps(node, lower, upper) && core_may_hold(node);
        // A node that could leave too many entries behind stays an entry itself, for the pixels to descend from.
        const bool is_entry = node.is_leaf || n_entries + stack_size + 2u > CORE_TILE_CAPACITY;
        if (is_touched && is_entry) {
            core_tiles[first + n_entries] = index;
            n_entries += 1u;
        }
        if (is_touched && !is_entry) {
            stack[stack_size] = node.child + 1u;
            stack[stack_size + 1u] = node.child;
            stack_size += 2u;
        }
        if (stack_size == 0u) {
            break;
        }
    }
    // Then pixels descend from the root.
    const bool is_cut_short = is_wanted && (stack_size > 0u || core_has_driver_given_up(n_tiles >> 31));
    if (is_cut_short) {
        core_tiles[first] = 0u;
    }
    if (is_wanted) {
        core_tiles[tile * CORE_TILE_STRIDE] = is_cut_short ? 1u : n_entries;
    }
    if (is_cut_short || n_entries > 0u) {
        core_list_tile(tile, 0u, n_tiles);
    }
}
