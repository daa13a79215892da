// Where the rays of a picture meet one cut plane, for the elements of one class: finds the element, evaluates the field.
//
// Several planes and classes merge in core_samples: the nearest plane wins; on one plane, the element on the viewer's side, then the
// lowest number. One field evaluation a pixel and class, after the search.
//
// A work group is a tile of pixels, an invocation one of its columns: what the whole tile shares is fetched once.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "library/precision.glsl"
#include "library/cut_frame.glsl"
#include "library/cut_tiles.glsl"
#include "library/samples.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) readonly buffer core_tiles_block { uint core_tiles[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first_tile_row;
    // Counted from 1; 0 is no surface.
    uint core_surface;
    // Components of the field: the only one, or all that make up the length of the vector.
    uint core_first_component;
    uint core_end_component;
    // Two values on a face: which one is shown there may depend on rounding.
    uint core_is_discontinuous;
};

uint core_first_entry() {
    return (gl_WorkGroupID.x + (core_first_tile_row + gl_WorkGroupID.y) * gl_NumWorkGroups.x) * CORE_TILE_STRIDE + 1u;
}

uint core_entry(uint i) { return core_tiles[core_first_entry() + i]; }

#include "library/show.glsl"
#include "library/locate.glsl"

void main() {
    const uint column = gl_WorkGroupID.x * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint first_row = (core_first_tile_row + gl_WorkGroupID.y) * CORE_TILE_HEIGHT;
    const uint n_entries = core_tiles[core_first_entry() - 1u];
    const uint end_row = n_entries > 0u && column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    uint n_steps = 0u, n_failures = 0u, n_evaluations = 0u;
    const core_cut_column ray = core_cut_begin(elvis_real(column));
    core_track track = core_no_track();
    uint row = first_row;
    while (row < end_row) {
        const core_cut_point point = core_cut_pixel(ray, elvis_real(row));
        const core_location found = core_locate(point, point.is_hit ? n_entries : 0u, track);
        // For pixels outside, too: in a loop of one turn it would take three times as long, because compilers move all that does not
        // change with the turn in front of the loop and run out of registers.
        const bool has_found = found.element != CORE_NO_ELEMENT;
        const elvis_real value = core_shown_value(has_found ? found.element : 0u, elvis_vec3(found.x, found.y, found.z));
        const bool is_news = has_found || found.n_failures > 0u || found.is_cut_short;
        for (uint turn = 0u; turn < (is_news ? 1u : 0u); ++turn) {
            n_evaluations += core_merge(row * core_size.x + column, point, found, value);
        }
        n_steps += found.n_steps;
        n_failures += found.n_failures;
        row += 1u;
    }

    // Then no pixel of the column is to be trusted.
    const bool is_cut_short = end_row > first_row && (row < end_row || core_has_driver_given_up());
    for (uint i = first_row; i < (is_cut_short ? end_row : first_row); ++i) {
        core_marks[i * core_size.x + column].flags |= CORE_FLAG_WORK_LIMIT;
    }

    for (uint turn = 0u; turn < (end_row > first_row ? 1u : 0u); ++turn) {
        const uint all_evaluations = subgroupAdd(n_evaluations);
        const uint all_steps = subgroupAdd(n_steps);
        const uint all_failures = subgroupAdd(n_failures);
        if (subgroupElect()) {
            atomicAdd(core_counts[0], all_evaluations);
            atomicAdd(core_counts[1], all_steps);
            atomicAdd(core_counts[2], all_failures);
        }
    }
}
