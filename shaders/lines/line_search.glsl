// The search for lines in one pixel of a surface.
//
// Each element that may reach into the pixel is asked by itself, with its own values, so that a jump between elements is no contour.
// The pixel's square is one subpixel at first; a subpixel in which the answer is open (lines/subpixel.glsl) is divided in four, down to a
// level. An iteration evaluates mapping and field once, whatever element and subpixel a lane is at.
//
// The kernel brings CORE_WORK_LIMIT, and the surface: one of lines/on_plane.glsl, on_tangent_plane.glsl, on_quadric.glsl and
// on_faces.glsl. These define
//
//     core_surface           what the pixel shows of the surface; `box` holds it
//     core_enter             takes the item of a leaf as the next element, unless it is known to lie elsewhere; with a start in it
//     core_square_on         what a square of the picture shows of the surface, and what an element has to do with it
//     core_is_left_out       whether the element has no line to show there
//     core_expected_point    where on the surface the middle of a square is
//     CORE_MOVES_FIRST       1: a subpixel is judged from near it alone; 0: from far, too, where that is enough

// Times the mapping is linearized anew nearer to a subpixel before the subpixel is judged.
#define CORE_MAX_MOVES 8u

void core_next_element(core_surface surface, inout core_line_search search) {
    while (search.element == CORE_NO_ELEMENT && search.stack_size > 0u) {
        search.stack_size -= 1u;
        const core_node node = core_fetch_node(core_stack[search.stack_size]);
        const bool is_touched = core_overlaps(node, surface.box.lower, surface.box.upper);
        if (is_touched && !node.is_leaf) {
            core_stack[search.stack_size] = node.child + 1u;
            core_stack[search.stack_size + 1u] = node.child;
            search.stack_size += 2u;
        }
        if (is_touched && node.is_leaf) {
            core_enter(surface, node.child, search);
        }
        if (search.element != CORE_NO_ELEMENT || search.stack_size == 0u) {
            break;
        }
    }
}

// Notes what is met for certain, and tells what stays open. `is_judged`: false if the square is not to be looked at.
void core_judge(core_shown_square square, core_element_image image, bool is_judged, inout core_line_marks lines,
                out bool leaves_contour, out bool leaves_mesh) {
    const bool is_inside = square.corners.all_hit && square.subpixel.is_inside;
    bool finds_contour = false;
    leaves_contour = false;
#if CORE_WITH_CONTOURS
    elvis_real value;
    const core_model model = core_shown_model(image.element, image.xi, square.subpixel.region, value);
    const core_isovalue_test test = core_test_isovalues(model, square.subpixel.region);
    finds_contour = is_judged && lines.wants_contour && square.is_seen && is_inside && test.is_met;
    leaves_contour =
        is_judged && lines.wants_contour && !finds_contour && !(square.corners.all_hit && test.is_excluded);
    const bool rests_on_estimates = is_judged && core_n_isovalues > 0u && core_is_model_estimated(image.element);
    lines.is_estimated = lines.is_estimated || rests_on_estimates;
#endif
    core_find_lines(lines, finds_contour, is_judged && lines.wants_mesh && square.is_seen && square.subpixel.is_crossed);
    leaves_mesh = is_judged && lines.wants_mesh && !is_inside;
}

// The point of the element at which the mapping is linearized next, expected to be the middle of the subpixel.
void core_predict(core_surface surface, core_shown_square square, core_element_image image, inout core_line_search search) {
    bool is_met;
    const elvis_vec3 expected = core_expected_point(surface, square, core_searched_place(search), is_met);
    const elvis_vec3 step = core_to_xi(square.frame, image.shift - image.position + expected);
    const bool is_usable = is_met && core_is_finite(step.x + step.y + step.z);
    elvis_vec3 next = image.xi + (is_usable ? clamp(step, elvis_real(-4), elvis_real(4)) : elvis_vec3(0));
    core_project(next.x, next.y, next.z);
    // Whole steps may go to and fro between points of a strongly curved element.
    const elvis_real share = search.moves > CORE_MAX_MOVES / 2u ? elvis_real(0.5LF) : elvis_real(1);
    search.x += share * (next.x - search.x);
    search.y += share * (next.y - search.y);
    search.z += share * (next.z - search.z);
}

// Asks the element about the subpixel, and goes on: nearer to it, below it, or behind it.
void core_ask_element(core_surface surface, inout core_line_search search) {
    const bool is_active = search.element != CORE_NO_ELEMENT;
    const core_element_image image =
        core_element_image_at(is_active ? search.element : 0u, elvis_vec3(search.x, search.y, search.z));
    const core_shown_square square = core_square_on(surface, search, image, core_searched_place(search));
    search.n_evaluations += is_active ? 1u : 0u;
    const core_approach approach = core_approach_to(square.subpixel, image);
    const bool is_in = is_active && !square.is_absent && !core_is_left_out(surface, search, square, approach);
    const bool may_move = is_in && square.corners.all_hit && approach.is_far && search.moves < CORE_MAX_MOVES;
    const bool is_judged = is_in && !(CORE_MOVES_FIRST != 0 && may_move);

    bool leaves_contour, leaves_mesh;
    core_judge(square, image, is_judged, search.lines, leaves_contour, leaves_mesh);
    const bool is_left_open = leaves_contour || leaves_mesh;
    const bool moves_on = may_move && (CORE_MOVES_FIRST != 0 || is_left_open);
    search.moves = moves_on ? search.moves + 1u : 0u;
    const bool is_divided = is_left_open && !moves_on && search.level < search.most_level;
    // Of a square that is larger than the pixel, only lines in the pixel can decide what it leaves open.
    const bool stays_open = !moves_on && (!is_divided || square.is_oversized);
    core_leave_open(search.lines, leaves_contour && stays_open, leaves_mesh && stays_open);
    const bool is_settled = is_judged && square.is_whole && square.subpixel.is_inside && !leaves_contour;
    search.goes_on = core_wants_lines(search.lines) && !is_settled;

    search.level += is_divided ? 1u : 0u;
    search.across = is_divided ? 2u * search.across : search.across;
    search.down = is_divided ? 2u * search.down : search.down;
    const bool is_done = is_active && !moves_on && !is_divided;
    if (is_done) {
        const bool has_next = core_next_subpixel(search.level, search.across, search.down);
        search.element = has_next ? search.element : CORE_NO_ELEMENT;
    }
    if (search.element != CORE_NO_ELEMENT) {
        core_predict(surface, square, image, search);
    }
}

void core_search_lines(core_surface surface, inout core_line_search search) {
    while (core_is_unfinished(search) && search.work < CORE_WORK_LIMIT) {
        search.work += 1u;
        core_next_element(surface, search);
        core_ask_element(surface, search);
        if (!core_is_unfinished(search)) {
            break;
        }
    }
}
