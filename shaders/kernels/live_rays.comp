// Which tiles hold rays that have something to do (library/volume_state.glsl): for each row of tiles from which one on, and before
// which. An idle tile of kernels/volume_march.comp takes a tenth of a busy one's time.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "library/volume_state.glsl"

layout(set = 0, binding = 0, std430) buffer core_states_block { core_volume_state core_states[]; };
// Two numbers a row of tiles: the first one, and one more than the last.
layout(set = 0, binding = 1, std430) buffer core_ranges_block { uint core_ranges[]; };
// For each tile: 0 if there is nothing in which its rays can start (kernels/ray_tiles.comp).
layout(set = 0, binding = 2, std430) readonly buffer core_has_starts_block { uint core_has_starts[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_tiles_per_row;
    uint core_first_tile_row;
    // Rays that look for a start, and those that can find none end; else those that go on in these elements, and rays that found no start end.
    uint core_seeks;
    uint core_first_element;
    uint core_n_elements;
};

void main() {
    const uint column = gl_GlobalInvocationID.x;
    const uint tile_row = core_first_tile_row + gl_WorkGroupID.y, first_row = tile_row * CORE_TILE_HEIGHT;
    const bool has_starts = core_has_starts[tile_row * core_tiles_per_row + gl_WorkGroupID.x] != 0u;
    const uint end_row = column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    bool is_live = false;
    for (uint row = first_row; row < end_row; ++row) {
        const uint pixel = row * core_size.x + column;
        const uint status = core_states[pixel].status, element = core_states[pixel].element;
        const bool has_sought = status == CORE_RAY_HAS_SOUGHT;
        const bool ends = core_seeks != 0u ? status == CORE_RAY_SEEKS && !has_starts : has_sought && element == CORE_NO_ELEMENT;
        const bool is_own = element >= core_first_element && element - core_first_element < core_n_elements;
        const bool goes = (status == CORE_RAY_GOES || has_sought) && is_own;
        const bool seeks = (status == CORE_RAY_SEEKS && has_starts) || has_sought;
        is_live = is_live || (core_seeks != 0u ? seeks : goes && !ends);
        if (ends) {
            core_states[pixel].status = CORE_RAY_ENDS;
        }
    }
    const uint n_live = subgroupAdd(is_live ? 1u : 0u);
    if (subgroupElect() && n_live > 0u) {
        atomicMin(core_ranges[2u * tile_row], gl_WorkGroupID.x);
        atomicMax(core_ranges[2u * tile_row + 1u], gl_WorkGroupID.x + 1u);
    }
}
