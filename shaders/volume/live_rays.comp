// Which groups of rays (tiles/ray_group.glsl) have something to do (volume/volume_state.glsl), of those in a list. An idle group of
// volume/volume_march.comp takes a tenth of a busy one's time.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/read_only.glsl"
#include "tiles/ray_group.glsl"
#include "volume/volume_state.glsl"

layout(set = 0, binding = 0, std430) buffer core_states_block { core_volume_state core_states[]; };
// For each tile: 0 if there is nothing in which its rays can start (tiles/ray_tiles.comp).
layout(set = 0, binding = 1) CORE_READ_WORDS(core_has_starts);
layout(set = 0, binding = 2) CORE_READ_WORDS(core_groups);
// Groups with rays that have something to do; with rays that have not ended.
layout(set = 0, binding = 3, std430) writeonly buffer core_live_block { uint core_live[]; };
layout(set = 0, binding = 4, std430) writeonly buffer core_open_block { uint core_open[]; };
// How many there are of each: live ones, and behind the other words of a dispatch's size, open ones.
layout(set = 0, binding = 5, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    // Of the list.
    uint core_first, core_n_groups;
    // If 1: lists rays that seek, and ends those that cannot find a start. If 0: lists rays that walk in this class, and ends those that
    // found none.
    uint core_seeks;
    uint core_first_element;
    uint core_n_elements;
};

// Whether any ray of a group is live, and open.
shared uint core_is_live[CORE_GROUPS];
shared uint core_is_open[CORE_GROUPS];

void main() {
    const uint lane = gl_LocalInvocationID.x, tiles_a_row = (core_size.x + CORE_TILE_WIDTH - 1u) / CORE_TILE_WIDTH;
    const uint first = core_first + gl_WorkGroupID.x * CORE_GROUPS, end = min(first + CORE_GROUPS, core_first + core_n_groups);
    for (uint i = lane; i < CORE_GROUPS; i += CORE_TILE_WIDTH) {
        core_is_live[i] = core_is_open[i] = 0u;
    }
    barrier();
    for (uint i = first; i < end; ++i) {
        const uvec2 place = core_pixel_in_group(CORE_WORD(core_groups, i), lane, core_size.x);
        const bool is_pixel = place.x < core_size.x && place.y < core_size.y;
        const uint pixel = is_pixel ? place.y * core_size.x + place.x : 0u;
        const uint tile = place.y / CORE_TILE_HEIGHT * tiles_a_row + place.x / CORE_TILE_WIDTH;
        const bool has_starts = is_pixel && CORE_WORD(core_has_starts, tile) != 0u;
        const uint status = core_states[pixel].walk.status, global_element = core_states[pixel].walk.global_element;
        const bool has_sought = status == CORE_RAY_HAS_SOUGHT;
        const bool ends = core_seeks != 0u ? status == CORE_RAY_SEEKS && !has_starts : has_sought && global_element == CORE_NO_ELEMENT;
        const bool is_of_class = global_element >= core_first_element && global_element - core_first_element < core_n_elements;
        const bool goes = (status == CORE_RAY_GOES || has_sought) && is_of_class;
        const bool seeks = (status == CORE_RAY_SEEKS && has_starts) || has_sought;
        const bool is_live = is_pixel && (core_seeks != 0u ? seeks : goes && !ends);
        if (is_live) {
            core_is_live[i - first] = 1u;
        }
        if (is_pixel && !ends && status != CORE_RAY_ENDS) {
            core_is_open[i - first] = 1u;
        }
        if (is_pixel && ends) {
            core_states[pixel].walk.status = CORE_RAY_ENDS;
        }
    }
    barrier();
    for (uint i = lane; first + i < end; i += CORE_TILE_WIDTH) {
        const uint group = CORE_WORD(core_groups, first + i);
        if (core_is_live[i] != 0u) {
            core_live[atomicAdd(core_counts[0], 1u)] = group;
        }
        if (core_seeks != 0u && core_is_open[i] != 0u) {
            core_open[atomicAdd(core_counts[3], 1u)] = group;
        }
    }
}
