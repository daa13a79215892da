// Asks elements about subpixels, in the search for lines in one pixel (lines/line_search.glsl).
//
// Each element that may reach into the pixel is asked by itself, with its own values, so that a jump between elements is no contour.
// The pixel's square is one subpixel at first; a subpixel in which the answer is open (lines/subpixel.glsl) is divided in four, down to a
// level. One evaluation of mapping and field an iteration, whatever element and subpixel a lane is at.
//
// The surface is one of lines/on_plane.glsl, on_tangent_plane.glsl, on_quadric.glsl and on_faces.glsl. These define, beside what
// lines/line_search.glsl wants,
//
//     core_square_on         what a square of the picture shows of the surface, and what an element has to do with it
//     core_expected_point    where on the surface the middle of a square is
//     CORE_MOVES_FIRST       1: a subpixel is judged from near it alone; 0: from far, too, where that is enough
//     CORE_FACES_IN_SURFACE  1: elements on both sides may have faces in the surface

#include "lines/isovalue_test.glsl"
#include "lines/subpixel_quadtree.glsl"

// Times the mapping is linearized anew nearer to a subpixel before the subpixel is judged.
#define CORE_MOST_MOVES 8u

// The point of the element at which the mapping is linearized next, expected to be the middle of the subpixel.
void core_predict(const core_surface surface, const core_shown_square square, const core_element_image image,
                  inout core_line_search search) {
    bool is_met;
    const elvis_vec3 expected = core_expected_point(surface, square, core_searched_place(search), is_met);
    const elvis_vec3 step = core_to_xi(square.frame, image.shift - image.position + expected);
    const bool is_usable = is_met && core_is_finite(step.x + step.y + step.z);
    elvis_vec3 next = image.xi + (is_usable ? clamp(step, elvis_real(-4), elvis_real(4)) : elvis_vec3(0));
    core_project(next.x, next.y, next.z);
    // Whole steps may go to and fro between points of a strongly curved element.
    const elvis_real share = search.moves > CORE_MOST_MOVES / 2u ? elvis_real(0.5LF) : elvis_real(1);
    search.x += share * (next.x - search.x);
    search.y += share * (next.y - search.y);
    search.z += share * (next.z - search.z);
}

// Goes on nearer to the subpixel, below it, or behind it.
void core_go_on(core_surface surface, core_shown_square square, core_element_image image, bool is_active, bool moves_on,
                bool is_divided, inout core_line_search search) {
    search.moves = moves_on ? search.moves + 1u : 0u;
    search.level += is_divided ? 1u : 0u;
    search.across = is_divided ? 2u * search.across : search.across;
    search.down = is_divided ? 2u * search.down : search.down;
    const bool is_done = is_active && !moves_on && !is_divided;
    if (is_done) {
        const bool has_next = core_next_subpixel(search.level, search.across, search.down);
        search.item = has_next ? search.item : CORE_NO_ITEM;
    }
    if (search.item != CORE_NO_ITEM) {
        core_predict(surface, square, image, search);
    }
}

void core_ask(core_surface surface, inout core_line_search search) {
    const bool is_active = search.item != CORE_NO_ITEM;
    core_element_image image = core_element_image_at(is_active ? search.item : 0u, elvis_vec3(search.x, search.y, search.z));
#if CORE_STRONGLY_BENT
    const elvis_vec3 from_part = image.xi - elvis_vec3(search.part_x, search.part_y, search.part_z);
    const bool knows_part = search.part_half_side >= elvis_real(0);
    image.farthest = knows_part ? core_max_norm(from_part) + search.part_half_side : elvis_real(-1);
#endif
    const core_shown_square square = core_square_on(surface, search, image, core_searched_place(search));
    search.n_evaluations += is_active ? 1u : 0u;
    const bool is_known = square.corners.all_hit;
    const bool is_out = square.is_absent ||
                        (is_known && (square.subpixel.is_outside || square.approach.is_clear || square.is_hidden));
    const bool may_move = is_active && !is_out && is_known && square.approach.is_far && search.moves < CORE_MOST_MOVES;
    const bool is_judged = is_active && !is_out && !(CORE_MOVES_FIRST != 0 && may_move);

    core_line_marks lines = search.lines;
    const bool is_inside = is_known && square.subpixel.is_inside;
    const core_isovalue_test test = core_isovalues_in(image, square.subpixel.region);
    const bool shows_contour = square.is_seen && !square.may_hide_contour;
    const bool ends = is_judged && lines.wants_mesh && square.is_seen && square.subpixel.is_crossed;
#if CORE_FACES_IN_SURFACE
    search.ending_sides |= ends ? square.wanted_sides : 0u;
    const bool meets_mesh = ends && (square.wanted_sides == 0u || search.ending_sides == (CORE_BEFORE | CORE_BEHIND));
#else
    const bool meets_mesh = ends;
#endif
    core_record_lines(lines, is_judged && lines.wants_contour && shows_contour && is_inside && test.is_met, meets_mesh);
    const bool leaves_contour = is_judged && lines.wants_contour && !(is_known && test.is_excluded);
    // It ends on one side: open, unless one on the other side ends, too. More of it need not be known.
    const bool is_one_sided = ends && !meets_mesh;
    const bool leaves_mesh = is_judged && lines.wants_mesh && !is_inside && !is_one_sided;
    const bool is_left_open = leaves_contour || leaves_mesh;
    const bool moves_on = may_move && (CORE_MOVES_FIRST != 0 || is_left_open);
    const bool is_divided = is_left_open && !moves_on && search.level < search.most_level;
    // A square larger than the pixel cannot prove a line. Its open answer stays unless a smaller square finds one.
    const bool stays_open = !moves_on && (!is_divided || square.is_oversized);
    core_leave_open(lines, leaves_contour && stays_open, (leaves_mesh && stays_open) || is_one_sided);
    lines.is_estimated = lines.is_estimated || (is_judged && test.is_estimated);
    search.lines = lines;
#if CORE_STRONGLY_BENT
    search.is_filled = search.is_filled && (!is_active || moves_on || is_divided || (is_judged && is_inside));
#endif
    search.goes_on = core_is_looking(lines) && !(is_judged && square.is_whole_pixel && is_inside && !leaves_contour);
    core_go_on(surface, square, image, is_active, moves_on, is_divided, search);
}

#if CORE_STRONGLY_BENT
// Of strongly bent elements little is known from afar. So the element that the pixel's middle shows is asked by itself first: where it
// fills the pixel, no other one counts, whatever it would leave open.
void core_begin_turn(bool asks_own, uint stack_size, inout core_line_search search) {
    search.asks_own = search.is_filled = asks_own;
    search.lines.is_contour_open = search.lines.is_mesh_open = false;
    search.item = CORE_NO_ITEM;
    search.stack_size = stack_size;
    search.work = 0u;
}

bool core_has_own_filled(const core_line_search search) {
    return search.n_evaluations > 0u && search.is_filled && !core_is_unfinished(search);
}
#endif
