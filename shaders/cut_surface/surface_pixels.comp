// The crossings of a picture's rays with a surface (surface/hits.comp), for the elements of one class: finds the element,
// evaluates the field. As cut_surface/cut_plane.comp, but for where the points come from.
//
// A work group is a tile of pixels, an invocation one of its columns.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "tiles/node_tiles.glsl"
#include "element/place.glsl"
#include "picture/samples.glsl"

#include "cut_surface/hit_point.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2) CORE_READ_WORDS(core_tiles);
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 5, std430) readonly buffer core_hits_block { core_hit_record core_hits[]; };
// Written if core_wants_places.
layout(set = 0, binding = 7, std430) writeonly buffer core_places_block { core_place core_places[]; };
#include "cut_surface/point_parameters.glsl"

#define CORE_LISTED_BINDING 8
#include "tiles/listed_tile.glsl"

uint core_first_entry() { return core_listed_tile(core_first) * CORE_TILE_STRIDE + 1u; }

uint core_entry(uint i) { return CORE_WORD(core_tiles, core_first_entry() + i); }

#define CORE_OTHERS_BINDING 6
#include "cut_surface/other_elements.glsl"
#define CORE_OPEN_POINTS_BINDING 9
#define CORE_WANTED_REACHES_BINDING 10
#include "cut_surface/open_points.glsl"
#include "arithmetic/count.glsl"
#include "picture/show.glsl"
#include "picture/distrust_column.glsl"
#define CORE_ON_PLANE 0
#include "cut_surface/locate.glsl"

// The column's next pixel with a crossing of this round, from a row on.
uint core_next_row(uint column, uint row, uint end_row) {
    bool is_idle = true;
    while (is_idle && row < end_row) {
        is_idle = core_hits[row * core_size.x + column].t >= CORE_FAR;
        row += is_idle ? 1u : 0u;
        if (!is_idle || row >= end_row) {
            break;
        }
    }
    return row;
}

void main() {
    const uint tile = core_listed_tile(core_first), tiles_per_row = (core_size.x + CORE_TILE_WIDTH - 1u) / CORE_TILE_WIDTH;
    const uint column = tile % tiles_per_row * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint first_row = tile / tiles_per_row * CORE_TILE_HEIGHT;
    const uint n_entries = CORE_WORD(core_tiles, core_first_entry() - 1u);
    const uint end_row = n_entries > 0u && column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    uint n_steps = 0u, n_failures = 0u, n_evaluations = 0u, n_found = 0u;
    const core_cut_column along = core_cut_begin(elvis_real(column));
    const elvis_real data_error = core_data_error();
    core_track track = core_no_track();
    uint row = core_next_row(column, first_row, end_row);
    while (row < end_row) {
        const uint pixel = row * core_size.x + column;
        core_cut_point point = core_hit_point(along, elvis_real(row), core_hits[pixel], core_most_error);
        point.error += data_error;
        const core_location found = core_locate(point, n_entries, track);
        const bool has_found = found.element != CORE_NO_ELEMENT;
        const elvis_real value = core_shown_value(has_found ? found.element : 0u, elvis_vec3(found.x, found.y, found.z));
        const bool is_news = has_found || found.n_failures > 0u || found.is_cut_short;
        if (is_news) {
            const bool was_open = core_marks[pixel].owner >> CORE_OWNER_BITS != core_surface_number;
            const uint n_done = core_merge(pixel, point, found, value);
            n_evaluations += n_done;
            core_list_other(pixel, found);
            if (n_done > 0u && core_wants_places != 0u) {
                core_places[pixel] =
                    core_place(found.x, found.y, found.z, found.element, CORE_CLASS << CORE_PLACE_FACE_BITS);
            }
            n_found += has_found && was_open ? 1u : 0u;
        }
        core_list_open_point(pixel, found);
        n_steps += found.n_steps;
        n_failures += found.n_failures;
        row = core_next_row(column, row + 1u, end_row);
        if (row >= end_row) {
            break;
        }
    }
    core_distrust_column(column, first_row, row, end_row, core_surface_number >> 31);
    if (end_row > first_row) {
        core_count(0u, n_evaluations);
        core_count(1u, n_steps);
        core_count(2u, n_failures);
        core_count(3u, n_found);
    }
}
