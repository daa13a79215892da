// The search for lines in one pixel, between two of its iterations (lines/line_search.glsl). All of it is scalars, which may be carried
// round a loop (README.md).

#ifndef CORE_SEARCH_STATE
#define CORE_SEARCH_STATE

#include "arithmetic/precision.glsl"
#include "tiles/hierarchy.glsl"
#include "lines/line_marks.glsl"
#include "lines/shown_square.glsl"
#include "lines/subpixel_quadtree.glsl"

#define CORE_NO_ELEMENT 0xffffffffu

#ifndef CORE_LINE_STACK_SIZE
#define CORE_LINE_STACK_SIZE CORE_STACK_SIZE
#endif
// Nodes of the hierarchy that are still to be looked at.
uint core_stack[CORE_LINE_STACK_SIZE];

struct core_line_search {
    core_line_marks lines;
    // Whether an answer is still missing.
    bool goes_on;
    uint stack_size;
    // The one that is asked; CORE_NO_ELEMENT if the next one is to be found.
    uint element;
    // On faces: the one of the element in which the surface lies; and the last one asked, of any element.
    int own_face;
    uint last_face;
    // The pixel, and its subpixel that the element is asked about. Subpixels are not divided beyond a level.
    elvis_real column, row;
    uint level, across, down, most_level;
    // Where in the element the mapping is linearized, and how often that has been moved nearer to this subpixel.
    elvis_real x, y, z;
    uint moves;
    uint work, n_evaluations;
};

// `has_nodes`: from the root of the hierarchy on.
core_line_search core_begin_search(elvis_real column, elvis_real row, uint most_level, core_line_marks lines, bool has_nodes) {
    core_line_search search;
    search.lines = lines;
    search.goes_on = core_wants_lines(lines);
    core_stack[0] = 0u;
    search.stack_size = has_nodes ? 1u : 0u;
    search.element = search.last_face = CORE_NO_ELEMENT;
    search.own_face = 0;
    search.column = column;
    search.row = row;
    search.level = search.across = search.down = search.moves = search.work = search.n_evaluations = 0u;
    search.most_level = most_level;
    search.x = search.y = search.z = elvis_real(0);
    return search;
}

// `start`: a prediction for the pixel.
void core_begin_element(inout core_line_search search, elvis_vec3 start) {
    search.x = start.x;
    search.y = start.y;
    search.z = start.z;
    core_project(search.x, search.y, search.z);
    search.level = search.across = search.down = search.moves = 0u;
}

bool core_is_unfinished(core_line_search search) {
    return search.goes_on && (search.element != CORE_NO_ELEMENT || search.stack_size > 0u);
}

core_picture_square core_searched_place(core_line_search search) {
    return core_subpixel_place(search.column, search.row, search.level, search.across, search.down);
}

// A box in the coordinates of the hierarchy.
struct core_box {
    vec3 lower, upper;
};

core_box core_widened(core_box box, float margin) { return core_box(box.lower - margin, box.upper + margin); }

core_box core_box_of_corners(core_cut_square square) {
    const vec3 in_hierarchy = vec3(core_reference_in_hierarchy.xyz);
    const vec3 q0 = vec3(square.corner0) + in_hierarchy, q1 = vec3(square.corner1) + in_hierarchy;
    const vec3 q2 = vec3(square.corner2) + in_hierarchy, q3 = vec3(square.corner3) + in_hierarchy;
    return core_box(min(min(q0, q1), min(q2, q3)), max(max(q0, q1), max(q2, q3)));
}

// By how much points between the corners may lie outside of their box, if they have this error.
float core_box_margin(core_box box, elvis_real error) {
    const vec3 size = max(abs(box.lower), abs(box.upper)) + abs(vec3(core_reference_in_hierarchy.xyz));
    return 2.0 * float(error) + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(size.x, size.y), size.z);
}

#endif
