// The pixel of an invocation, from the list of those that are still open, on any surface but planes: it is decided, or listed anew.

#include "arithmetic/driver_limit.glsl"
#include "arithmetic/precision.glsl"
#include "arithmetic/read_only.glsl"
#include "lines/line_marks.glsl"

layout(set = 0, binding = 2) CORE_READ_REALS(core_normals);
// Words of element/place.glsl, as in core_open.
layout(set = 0, binding = 7) CORE_READ_WORDS(core_list);
#if CORE_ON_FACES
layout(set = 0, binding = 1) CORE_READ_SAMPLES(core_samples);
layout(set = 0, binding = 6, std430) readonly buffer core_places_block { core_place core_places[]; };
layout(set = 0, binding = 8, std430) writeonly buffer core_open_block { uint core_open[]; };
#else
layout(set = 0, binding = 6) CORE_READ_REALS(core_bending);
layout(set = 0, binding = 8) CORE_READ_SAMPLES(core_samples);
layout(set = 0, binding = 9, std430) writeonly buffer core_open_block { uint core_open[]; };
#endif
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first;
    uint core_n_listed;
    uint core_class;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_with_mesh_lines;
    uint core_subdivisions;
    // Which of the counts is that of core_open; 0 in the last round.
    uint core_open_count;
    // On faces: they are all of the boundary, and all rays start on the same side of it.
    uint core_is_closed;
};

#define CORE_FACES_IN_SURFACE 0
#include "lines/search_state.glsl"
#include "picture/surroundings.glsl"

struct core_listed_pixel {
    // False beyond the end of the list.
    bool is_pixel;
    uint pixel;
    elvis_real column, row;
    core_cut_ray ray;
    // Where the ray meets the surface.
    core_tangent tangent;
    core_surroundings around;
    // What is open in it.
    core_line_marks lines;
};

core_listed_pixel core_listed_pixel_here() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    core_listed_pixel listed;
    listed.is_pixel = i < core_first + core_n_listed;
    const uint word = CORE_WORD(core_list, listed.is_pixel ? i : core_first);
    listed.pixel = word & CORE_LIST_PIXEL;
    const uvec2 place = uvec2(listed.pixel % core_size.x, listed.pixel / core_size.x);
    listed.column = elvis_real(place.x);
    listed.row = elvis_real(place.y);
    listed.ray = core_cut_ray_at(listed.column, listed.row);
    listed.tangent = core_shown_tangent(listed.pixel, listed.ray);
    listed.around = core_look_around(place, listed.pixel, listed.is_pixel, listed.tangent);
    // Elements of another class may have found it.
    const uint known = core_marks[listed.pixel].flags;
    listed.lines = core_no_lines_yet(
        listed.is_pixel && (word & CORE_LIST_CONTOUR) != 0u && (known & CORE_FLAG_CONTOUR) == 0u,
        listed.is_pixel && (word & CORE_LIST_MESH_LINE) != 0u && (known & CORE_FLAG_MESH_LINE) == 0u);
    return listed;
}

// `is_complete`: what is looked at is all that there may be in the pixel; else that no line is met is not certain.
core_line_search core_begin_listed(core_listed_pixel listed, uint most_level, bool has_nodes, bool is_complete) {
    core_line_search search = core_begin_search(listed.column, listed.row, most_level, listed.lines, has_nodes);
    core_leave_open(search.lines, listed.lines.wants_contour && !is_complete, listed.lines.wants_mesh && !is_complete);
    return search;
}

void core_store_or_relist(core_listed_pixel listed, core_line_search search) {
    const bool has_driver_given_up = core_has_driver_given_up(core_size.x >> 31);
    const core_cut_square square =
        core_tangent_square(listed.tangent, core_picture_square(listed.column, listed.row, elvis_real(0.5LF)));
    // What was found with loops that the driver had ended says nothing.
    core_doubt_lines(has_driver_given_up || core_may_end_near(listed.pixel, square, listed.tangent), search.lines);
    const core_undecided open = core_undecided_lines(search.lines, core_is_unfinished(search) || has_driver_given_up);
    const bool is_last = core_open_count == 0u;
    if (listed.is_pixel && !is_last && core_is_any(open)) {
        core_open[atomicAdd(core_counts[core_open_count], 1u)] = core_word_of(listed.pixel, open);
    }
    if (listed.is_pixel) {
        core_mark_lines(listed.pixel, search.lines, core_undecided(is_last && open.is_contour, is_last && open.is_mesh));
    }
    core_count(0u, search.n_evaluations);
}
