// The search for lines in one pixel between two iterations (lines/line_search.glsl). It is all scalars, which may be carried round a
// loop (README.md).

#include "arithmetic/precision.glsl"
#include "tiles/hierarchy.glsl"
#include "lines/line_marks.glsl"
#include "lines/shown_square.glsl"

// In place of an item of the hierarchy: an element, or a patch.
#define CORE_NO_ITEM 0xffffffffu

#define CORE_BEFORE 1u
#define CORE_BEHIND 2u

#ifndef CORE_LINE_STACK_SIZE
#define CORE_LINE_STACK_SIZE CORE_STACK_SIZE
#endif
// Nodes of the hierarchy that are still to be looked at.
uint core_stack[CORE_LINE_STACK_SIZE];

struct core_line_search {
    core_line_marks lines;
    // An answer is still missing.
    bool goes_on;
    uint stack_size;
    // What is asked: an element, or, in lines/face_lines_careful.comp, a patch. CORE_NO_ITEM if the next one is to be found.
    uint item;
    // On faces: the element's own one, and the last one asked, of any element.
    int own_face;
    uint last_face;
    // The pixel, and its subpixel that the element is asked about. Subpixels are not divided beyond a level.
    elvis_real column, row;
    uint level, across, down, most_level;
    // Where in the element the mapping is linearized, and how often that has been moved nearer to this subpixel.
    elvis_real x, y, z;
    uint moves;
    // Squares of the patch that are still to be looked at.
    uint n_squares;
    uint work, n_evaluations;
#if CORE_FACES_IN_SURFACE
    // Sides of the surface on which an element that has a face in it ends within the pixel: CORE_BEFORE, CORE_BEHIND.
    uint ending_sides;
#endif
#if CORE_STRONGLY_BENT
    // Only the element that the pixel's middle shows is asked; what was asked so far lies inside of it.
    bool asks_own, is_filled;
    // A cube around the part of the element that the pixel can show (lines/shown_part.glsl); its half side is negative where that is not
    // known.
    elvis_real part_x, part_y, part_z, part_half_side;
#endif
};

// From the root of the hierarchy on, if there is anything to be looked for.
core_line_search core_begin_search(elvis_real column, elvis_real row, uint most_level, const core_line_marks lines, bool has_nodes) {
    core_stack[0] = 0u;
    const elvis_real zero = elvis_real(0);
    return core_line_search(lines, core_is_looking(lines), has_nodes ? 1u : 0u, CORE_NO_ITEM, 0, CORE_NO_ITEM, column, row, 0u, 0u,
                            0u, most_level, zero, zero, zero, 0u, 0u, 0u, 0u
#if CORE_FACES_IN_SURFACE
                            , 0u
#endif
#if CORE_STRONGLY_BENT
                            , false, false, zero, zero, zero, elvis_real(-1)
#endif
    );
}

bool core_is_unfinished(const core_line_search search) {
    return search.goes_on && (search.item != CORE_NO_ITEM || search.stack_size > 0u);
}

// `start`: where the pixel's part of the surface is expected in the element.
void core_begin_element(inout core_line_search search, elvis_vec3 start) {
    search.x = start.x;
    search.y = start.y;
    search.z = start.z;
    core_project(search.x, search.y, search.z);
    search.level = search.across = search.down = search.moves = 0u;
#if CORE_STRONGLY_BENT
    search.part_half_side = elvis_real(-1);
#endif
}
