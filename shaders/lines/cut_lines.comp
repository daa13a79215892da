// Which of the listed pixels meet contours of the field, and boundaries of elements, on a cut plane; for the elements of one class, of
// which the list of the pixel's tile tells.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/samples.glsl"
#include "picture/view.glsl"
#include "tiles/node_tiles.glsl"

layout(set = 0, binding = 1) CORE_READ_WORDS(core_tiles);
layout(set = 0, binding = 2) CORE_READ_WORDS(core_list);
layout(set = 0, binding = 6) CORE_READ_SAMPLES(core_samples);
layout(push_constant) uniform core_parameters {
    uint core_width;
    uint core_tiles_per_row;
    uint core_first;
    uint core_n_listed;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_with_mesh_lines;
    uint core_subdivisions;
};

// Iterations of one pixel: far above what lines of a smooth field take, well below where drivers end loops.
#if CORE_STRONGLY_BENT
#define CORE_WORK_LIMIT 1500u
#else
#define CORE_WORK_LIMIT 2000u
#endif
#define CORE_WITH_CONTOURS 1
#define CORE_LINE_STACK_SIZE (CORE_STACK_SIZE + CORE_TILE_CAPACITY)

#include "arithmetic/driver_limit.glsl"
#include "lines/on_plane.glsl"
#include "lines/subpixel_search.glsl"
#include "lines/line_search.glsl"

// Puts what the list of the tile names on the stack, its first entry uppermost; returns their number.
uint core_stack_tile(uint column, uint row) {
    const uint tile = row / CORE_TILE_HEIGHT * core_tiles_per_row + column / CORE_TILE_WIDTH;
    const uint n_entries = CORE_WORD(core_tiles, tile * CORE_TILE_STRIDE);
    for (uint i = 0u; i < n_entries; ++i) {
        core_stack[i] = CORE_WORD(core_tiles, tile * CORE_TILE_STRIDE + n_entries - i);
    }
    return n_entries;
}

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = i < core_first + core_n_listed;
    const uint pixel = CORE_WORD(core_list, is_pixel ? i : core_first);
    const uint column = pixel % core_width, row = pixel / core_width;
    const uint owner = core_marks[pixel].owner;
    core_surface surface =
        core_plane_at(elvis_real(column), elvis_real(row), owner != 0u && (owner & CORE_OWNER_KEY) == 0u, owner == 0u);
    const bool is_seen = is_pixel && !surface.is_absent;
    const core_line_marks wanted =
        core_no_lines_yet(is_seen && core_n_isovalues > 0u, is_seen && core_with_mesh_lines != 0u);
    core_line_search search = core_begin_search(elvis_real(column), elvis_real(row), core_subdivisions, wanted, false);
#if CORE_STRONGLY_BENT
    surface.own_number = owner != 0u ? CORE_SAMPLE_NUMBER(core_samples, pixel) : CORE_NO_NUMBER;
    for (uint turn = owner != 0u ? 0u : 1u; turn < 2u; ++turn) {
        core_begin_turn(turn == 0u, core_stack_tile(column, row), search);
        core_search_lines(surface, search);
        if (turn == 1u || core_has_own_filled(search)) {
            break;
        }
    }
#else
    search.stack_size = core_stack_tile(column, row);
    core_search_lines(surface, search);
#endif
    // What was found with loops that the driver had ended says nothing.
    const bool has_driver_given_up = core_has_driver_given_up(core_width >> 31);
    core_doubt_lines(has_driver_given_up, search.lines);
    if (is_pixel) {
        core_mark_lines(pixel, search.lines, core_undecided_lines(search.lines, core_is_unfinished(search) || has_driver_given_up));
    }
    core_count(0u, search.n_evaluations);
}
