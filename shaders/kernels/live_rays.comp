// Which tiles hold rays that have something to do (library/volume_state.glsl): for each row of tiles from which one on, and before
// which. An idle tile of kernels/volume_march.comp takes a tenth of a busy one's time.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "library/volume_state.glsl"

layout(set = 0, binding = 0, std430) buffer core_states_block { core_volume_state core_states[]; };
// Two numbers a row of tiles: the first one, and one more than the last.
layout(set = 0, binding = 1, std430) buffer core_ranges_block { uint core_ranges[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    // Rays that look for a start; else those that go on in these elements, and rays that found no start end.
    uint core_seeks;
    uint core_first_element;
    uint core_n_elements;
};

void main() {
    const uint column = gl_GlobalInvocationID.x;
    const uint first_row = gl_WorkGroupID.y * CORE_TILE_HEIGHT;
    const uint end_row = column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    bool is_live = false;
    for (uint row = first_row; row < end_row; ++row) {
        const uint pixel = row * core_size.x + column;
        const uint status = core_states[pixel].status, element = core_states[pixel].element;
        const bool has_sought = status == CORE_RAY_HAS_SOUGHT;
        const bool ends = core_seeks == 0u && has_sought && element == CORE_NO_ELEMENT;
        const bool is_own = element >= core_first_element && element - core_first_element < core_n_elements;
        const bool goes = (status == CORE_RAY_GOES || has_sought) && is_own;
        const bool seeks = status == CORE_RAY_SEEKS || has_sought;
        is_live = is_live || (core_seeks != 0u ? seeks : goes && !ends);
        if (ends) {
            core_states[pixel].status = CORE_RAY_ENDS;
        }
    }
    const uint n_live = subgroupAdd(is_live ? 1u : 0u);
    if (subgroupElect() && n_live > 0u) {
        atomicMin(core_ranges[2u * gl_WorkGroupID.y], gl_WorkGroupID.x);
        atomicMax(core_ranges[2u * gl_WorkGroupID.y + 1u], gl_WorkGroupID.x + 1u);
    }
}
