// For each tile of pixels, the nodes of a hierarchy that the tile's share of the cut plane can touch.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"

layout(std430, set = 0, binding = 1) writeonly buffer core_output {
    uint core_tiles[];
};

layout(push_constant) uniform core_constants {
    uint core_tiles_per_row;
    uint core_n_tiles;
};

#define CORE_LISTED_BINDING 2
#define CORE_ON_PLANE 1
#include "tiles/list_nodes.glsl"
#include "cut_surface/cut_horizon.glsl"

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
    // the four points; otherwise, unless none does, the plane's horizon crosses the tile, which then takes all, unless it is behind the
    // volume.
    const bool all_hit = p00.is_hit && p10.is_hit && p01.is_hit && p11.is_hit;
    const bool any_hit = core_is_any_hit(p00, p10, p01, p11);
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

    const bool is_seen = all_hit || (any_hit && !core_is_behind_volume(p00, p10, p01, p11, core_volume_end()));
    core_list_nodes(tile, is_wanted, is_seen, lower, upper, core_n_tiles);
}
