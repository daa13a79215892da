// For each tile of pixels, the nodes of a hierarchy that the tile's part of the cut plane can touch: neighbouring pixels share most
// of their way through the hierarchy, so it is gone once for all of them.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "tiles/hierarchy.glsl"
#include "cut_surface/cut_horizon.glsl"
#include "tiles/cut_tiles.glsl"
#include "arithmetic/driver_limit.glsl"
#define CORE_LISTED_BINDING 2
#include "tiles/list_tile.glsl"

layout(std430, set = 0, binding = 1) writeonly buffer core_output {
    uint core_tiles[];
};

layout(push_constant) uniform core_constants {
    uint core_tiles_per_row;
    uint core_n_tiles;
};

void main() {
    const uint tile = gl_GlobalInvocationID.x;
    const bool is_wanted = tile < core_n_tiles;

    // Pixels are squares: lines are looked for up to their corners.
    const elvis_real half_pixel = elvis_real(0.5LF);
    const elvis_real column = elvis_real((tile % core_tiles_per_row) * CORE_TILE_WIDTH) - half_pixel;
    const elvis_real row = elvis_real((tile / core_tiles_per_row) * CORE_TILE_HEIGHT) - half_pixel;
    const elvis_real last_column = column + elvis_real(CORE_TILE_WIDTH);
    const elvis_real last_row = row + elvis_real(CORE_TILE_HEIGHT);
    const core_cut_column left = core_cut_begin(column), right = core_cut_begin(last_column);
    const core_cut_point p00 = core_cut_pixel(left, row), p10 = core_cut_pixel(right, row);
    const core_cut_point p01 = core_cut_pixel(left, last_row), p11 = core_cut_pixel(right, last_row);

    // Where the four corner rays meet the plane in front of the eye, the pixels between them meet it inside the quadrilateral of
    // the four points; where none does, none between does; otherwise the plane's horizon crosses the tile, which then takes all, unless it is behind the volume.
    const bool all_hit = p00.is_hit && p10.is_hit && p01.is_hit && p11.is_hit;
    const bool any_hit = p00.is_hit || p10.is_hit || p01.is_hit || p11.is_hit;
    const vec3 shift = vec3(core_reference_in_hierarchy.xyz);
    const vec3 q00 = vec3(p00.position) + shift, q10 = vec3(p10.position) + shift;
    const vec3 q01 = vec3(p01.position) + shift, q11 = vec3(p11.position) + shift;
    const float error = float(max(max(p00.error, p10.error), max(p01.error, p11.error)));
    const vec3 lowest = min(min(q00, q10), min(q01, q11)), highest = max(max(q00, q10), max(q01, q11));
    const vec3 size = max(abs(lowest), abs(highest)) + abs(shift);
    const float margin = 2.0 * error + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(size.x, size.y), size.z);
    const float infinite = 3e38;
    const vec3 lower = all_hit ? lowest - margin : vec3(-infinite);
    const vec3 upper = all_hit ? highest + margin : vec3(infinite);

    uint stack[CORE_STACK_SIZE];
    const bool is_seen = all_hit || (any_hit && !core_is_behind_volume(p00, p10, p01, p11, core_volume_end()));
    uint stack_size = is_wanted && is_seen ? 1u : 0u;
    stack[0] = 0u;
    uint n_entries = 0u;
    const uint first = tile * CORE_TILE_STRIDE + 1u;
    while (stack_size > 0u) {
        stack_size -= 1u;
        const uint index = stack[stack_size];
        const core_node node = core_fetch_node(index);
        const bool is_touched = core_overlaps(node, lower, upper);
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
    const bool is_cut_short = is_wanted && (stack_size > 0u || core_has_driver_given_up(core_n_tiles >> 31));
    if (is_cut_short) {
        core_tiles[first] = 0u;
    }
    if (is_wanted) {
        core_tiles[tile * CORE_TILE_STRIDE] = is_cut_short ? 1u : n_entries;
    }
    if (is_cut_short || n_entries > 0u) {
        core_list_tile(tile, 0u, core_n_tiles);
    }
}
