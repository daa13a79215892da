// Which of the listed pixels of faces meet contours of the field, and edges of the faces; for the faces of one class.
//
// The face that the pixel shows is asked first, then all others of which patches reach into a box around the pixel's part of the
// tangent plane. The pixel's square is one subpixel of each; a subpixel in which the answer is open is halved in both directions, at most
// core_subdivisions times; none in a first round, which most pixels need no more than. Each subpixel lies on the tangent plane of the
// face near it (lines/own_face.glsl), so that what bends vanishes with the subpixel's size.
//
// A line is met if a subpixel says so on a face that faces the viewer as the one that the pixel shows. That none is met is certain if
// no subpixel is left open, and that face fills the pixel or the surface is smooth around it. What else stays open is listed for the
// next round, or for lines/face_lines_careful.comp.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "element/face_frame.glsl"
#include "boundary/face_patch.glsl"
#include "tiles/hierarchy.glsl"
#include "element/place.glsl"
#include "picture/samples.glsl"
#include "lines/face_line_bindings.glsl"
#include "lines/own_face.glsl"
#include "lines/subpixel_quadtree.glsl"
#include "arithmetic/driver_limit.glsl"
#include "picture/surroundings.glsl"
#if CORE_WITH_CONTOURS
#include "field/shown_model.glsl"
#endif

#define CORE_NO_ELEMENT 0xffffffffu
#define CORE_NO_WORD 0xffffffffu
// Iterations of one pixel: far above what lines of a smooth field take, well below where drivers end loops.
#define CORE_WORK_LIMIT 1500u
// Times the mapping is linearized anew nearer to a subpixel before the subpixel is judged.
#define CORE_MAX_MOVES 8u

// Whether a patch may reach into a box, and the parameters of its point nearest to the middle of the box, to first order.
bool core_patch_reaches(uint index, vec3 middle, vec3 half_size, out float u, out float v) {
    const vec4 to_u = uintBitsToFloat(elvis_fetch4_core_patches(index, 0u));
    const vec4 to_v = uintBitsToFloat(elvis_fetch4_core_patches(index, 1u));
    const vec4 to_s = uintBitsToFloat(elvis_fetch4_core_patches(index, 2u));
    const vec4 bounds = uintBitsToFloat(elvis_fetch4_core_patches(index, 3u));
    const core_square square = core_square_of(elvis_fetch4_core_patches(index, 4u).w);
    const float a = dot(to_u.xyz, middle) + to_u.w, b = dot(to_v.xyz, middle) + to_v.w, s = dot(to_s.xyz, middle) + to_s.w;
    u = square.a + square.size * clamp(a, -1.0, 1.0);
    v = square.b + square.size * clamp(b, -1.0, 1.0);
    const bool is_beside = abs(a) > 1.0 + bounds.x + dot(abs(to_u.xyz), half_size) ||
                           abs(b) > 1.0 + bounds.x + dot(abs(to_v.xyz), half_size);
    return !is_beside && abs(s) <= bounds.y + dot(abs(to_s.xyz), half_size);
}

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = i < core_first + core_n_listed;
    const uint word = core_list[is_pixel ? i : core_first];
    const uint pixel = word & CORE_LIST_PIXEL;
    const uvec2 place_in_picture = uvec2(pixel % core_size.x, pixel / core_size.x);
    const elvis_real column = elvis_real(place_in_picture.x), row = elvis_real(place_in_picture.y);
    const core_cut_column along = core_cut_begin(column);
    const elvis_real rows_down = row - along.row0;
    const elvis_vec3 direction = (along.direction + rows_down * along.direction_row).xyz;
    const core_place place = core_places[pixel];
    const int shown_face = core_face_of(place);
    const bool is_shown_class = core_class_of(place) == core_class;
    const bool enters = (place.class_and_face & CORE_PLACE_ENTERS) != 0u;
    const bool is_filled = (place.class_and_face & CORE_PLACE_FILLED) != 0u;

    core_tangent tangent;
    tangent.point = (along.base + rows_down * along.base_row).xyz +
                    (core_samples[pixel].depth / length(direction) - along.reference_distance) * direction;
    tangent.normal = elvis_vec3(core_normals[3u * pixel], core_normals[3u * pixel + 1u], core_normals[3u * pixel + 2u]);
    const core_surroundings around = core_look_around(place_in_picture, pixel, is_pixel, tangent);
    const core_cut_square square = core_tangent_square(tangent, column, row, elvis_real(0.5LF));
    const bool is_usable = is_pixel && !around.is_hidden;

    const vec3 in_hierarchy = vec3(core_reference_in_hierarchy.xyz);
    const vec3 q0 = vec3(square.corner0) + in_hierarchy, q1 = vec3(square.corner1) + in_hierarchy;
    const vec3 q2 = vec3(square.corner2) + in_hierarchy, q3 = vec3(square.corner3) + in_hierarchy;
    const vec3 lowest = min(min(q0, q1), min(q2, q3)), highest = max(max(q0, q1), max(q2, q3));
    const vec3 size = max(abs(lowest), abs(highest)) + abs(in_hierarchy);
    // And what a pixel's part of a smooth surface departs from its plane.
    const float across_square = length(highest - lowest);
    const float margin =
        2.0 * float(square.error) + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(size.x, size.y), size.z) + 0.1 * across_square;
    const vec3 lower = lowest - margin, upper = highest + margin;
    const vec3 middle = 0.5 * (lower + upper), half_size = 0.5 * (upper - lower);

    const uint known = core_marks[pixel].flags;
    bool wants_contour = (word & CORE_LIST_CONTOUR) != 0u && (known & CORE_FLAG_CONTOUR) == 0u;
    bool wants_mesh = (word & CORE_LIST_MESH_LINE) != 0u && (known & CORE_FLAG_MESH_LINE) == 0u;
    bool is_contour_open = false, is_mesh_open = false, has_contour = false, has_mesh_line = false, rests_on_estimates = false;
    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    uint stack_size = is_usable && !is_filled && square.all_hit ? 1u : 0u;
    uint element = is_usable && is_shown_class ? place.element : CORE_NO_ELEMENT;
    int own_face = is_shown_class ? shown_face : 0;
    uint last_face = CORE_NO_WORD;
    bool is_shown = is_shown_class;
    uint level = 0u, across = 0u, down = 0u, moves = 0u, work = 0u, n_evaluations = 0u;
    elvis_real x = is_shown_class ? place.x : elvis_real(0), y = is_shown_class ? place.y : elvis_real(0);
    elvis_real z = is_shown_class ? place.z : elvis_real(0);
    bool goes_on = wants_contour || wants_mesh;
    while (goes_on && (element != CORE_NO_ELEMENT || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (element == CORE_NO_ELEMENT && stack_size > 0u) {
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            const bool is_touched = core_overlaps(node, lower, upper);
            const uint candidate = is_touched && node.is_leaf ? node.child : CORE_NO_WORD;
            if (is_touched && !node.is_leaf) {
                stack[stack_size] = node.child + 1u;
                stack[stack_size + 1u] = node.child;
                stack_size += 2u;
            }
            if (candidate != CORE_NO_WORD) {
                float u, v;
                const bool reaches = core_patch_reaches(candidate, middle, half_size, u, v);
                const uint face = elvis_fetch4_core_patches(candidate, 4u).z;
                const uvec4 of_face = elvis_fetch4_core_faces(face, 0u);
                const bool is_done = is_shown_class && of_face.x == place.element && int(of_face.y) == shown_face;
                const bool is_taken = reaches && !is_done && face != last_face;
                last_face = is_taken ? face : last_face;
                element = is_taken ? of_face.x : CORE_NO_ELEMENT;
                own_face = int(of_face.y);
                const core_face frame = core_face_frame(own_face);
                const elvis_vec3 start =
                    frame.corner + elvis_real(0.5 * (u + 1.0)) * frame.a + elvis_real(0.5 * (v + 1.0)) * frame.b;
                x = start.x;
                y = start.y;
                z = start.z;
                core_project(x, y, z);
                level = across = down = moves = 0u;
                is_shown = false;
            }
            if (element != CORE_NO_ELEMENT || stack_size == 0u) {
                break;
            }
        }

        const bool is_active = element != CORE_NO_ELEMENT;
        const uint safe_element = is_active ? element : 0u;
        const elvis_vec3 xi = elvis_vec3(x, y, z);
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(safe_element, xi, position, jacobian);
        jacobian = core_full_jacobian(jacobian);
        const elvis_real cell_size = core_subpixel_size(level);
        const elvis_real curvature = elvis_fetch_core_curvatures(safe_element, 0u);
        const elvis_vec3 shift = core_reference.xyz - elvis_origin(safe_element);
        const core_own_subpixel own =
            core_own_subpixel_at(xi, position, jacobian, shift, max(own_face, 0), curvature,
                             core_subpixel_middle(column, across, cell_size), core_subpixel_middle(row, down, cell_size),
                             elvis_real(0.5LF) * cell_size);
        core_subpixel subpixel = own.subpixel;
#if ELVIS_HAS_INSIDE
        core_judge_inside(subpixel, safe_element, xi);
#endif
        n_evaluations += is_active ? 1u : 0u;

        // Nearer to the subpixel everything is known better: the point of the element that is nearest to its middle, if that is needed.
        const elvis_real subpixel_radius = abs(subpixel.region.radius - subpixel.region.beyond - subpixel.step);
        elvis_real near_x = subpixel.middle.x, near_y = subpixel.middle.y, near_z = subpixel.middle.z;
        core_project(near_x, near_y, near_z);
        const elvis_real move = max(max(abs(near_x - x), abs(near_y - y)), abs(near_z - z));
        const bool is_far = move > elvis_real(0.25LF) * subpixel_radius && move > elvis_real(16) * CORE_ROUNDOFF;
        const bool is_clear = !is_far && core_is_clear_of(subpixel, subpixel_radius, move, curvature);
        // Another sheet of the surface, farther behind than a smooth one departs from its plane: hidden by this one.
        const elvis_vec3 there =
            elvis_real(0.25LF) * (own.square.corner0 + own.square.corner1 + own.square.corner2 + own.square.corner3);
        const bool is_behind = around.is_smooth && !is_shown && !is_far &&
                               dot(tangent.normal, there - tangent.point) < elvis_real(-0.5LF) * elvis_real(across_square);
        const bool is_out = own.square.all_hit && (subpixel.is_outside || is_clear || is_behind);
#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
        const bool is_facing = true;
#else
        const bool is_facing = own.enters == enters;
#endif

        const bool is_judged = is_active && !is_out;
        const bool is_inside = own.square.all_hit && subpixel.is_inside;
        const bool finds_mesh = is_judged && is_facing && wants_mesh && own.square.all_hit && subpixel.is_crossed;
        bool finds_contour = false, leaves_contour = false;
#if CORE_WITH_CONTOURS
        elvis_real value;
        const core_model model = core_shown_model(safe_element, xi, subpixel.region, value);
        const core_isovalue_test test = core_test_isovalues(model, subpixel.region);
        finds_contour = is_judged && is_facing && wants_contour && is_inside && test.is_met;
        leaves_contour = is_judged && wants_contour && !finds_contour && !(own.square.all_hit && test.is_excluded);
        const bool has_estimate = is_judged && core_is_model_estimated(safe_element);
        rests_on_estimates = rests_on_estimates || has_estimate;
#endif
        has_contour = has_contour || finds_contour;
        has_mesh_line = has_mesh_line || finds_mesh;
        wants_contour = wants_contour && !finds_contour;
        wants_mesh = wants_mesh && !finds_mesh;
        const bool leaves_mesh = is_judged && wants_mesh && !is_inside;
        const bool is_left_open = leaves_contour || leaves_mesh;
        const bool moves_on = is_left_open && own.square.all_hit && is_far && moves < CORE_MAX_MOVES;
        moves = moves_on ? moves + 1u : 0u;
        const bool is_divided = is_left_open && !moves_on && level < core_subdivisions;
        const bool stays_open = !moves_on && !is_divided;
        is_contour_open = is_contour_open || (leaves_contour && stays_open);
        is_mesh_open = is_mesh_open || (leaves_mesh && stays_open);
        goes_on = wants_contour || wants_mesh;

        level += is_divided ? 1u : 0u;
        across = is_divided ? 2u * across : across;
        down = is_divided ? 2u * down : down;
        const bool is_done = is_active && !moves_on && !is_divided;
        if (is_done) {
            const bool has_next = core_next_subpixel(level, across, down);
            element = has_next ? element : CORE_NO_ELEMENT;
        }
        if (element != CORE_NO_ELEMENT) {
            const elvis_real next_size = core_subpixel_size(level);
            elvis_real t;
            const elvis_vec3 next = core_tangent_point(own.tangent, core_subpixel_middle(column, across, next_size),
                                                       core_subpixel_middle(row, down, next_size), t);
            const elvis_vec3 step = core_to_xi(own.frame, own.origin + next);
            const bool is_finite = t < CORE_FAR && core_is_finite(step.x + step.y + step.z);
            elvis_real next_x = x + (is_finite ? clamp(step.x, elvis_real(-4), elvis_real(4)) : elvis_real(0));
            elvis_real next_y = y + (is_finite ? clamp(step.y, elvis_real(-4), elvis_real(4)) : elvis_real(0));
            elvis_real next_z = z + (is_finite ? clamp(step.z, elvis_real(-4), elvis_real(4)) : elvis_real(0));
            core_project(next_x, next_y, next_z);
            // Whole steps may go to and fro between points of a strongly curved element.
            const elvis_real share = moves > CORE_MAX_MOVES / 2u ? elvis_real(0.5LF) : elvis_real(1);
            x += share * (next_x - x);
            y += share * (next_y - y);
            z += share * (next_z - z);
        }
        if (!goes_on || (element == CORE_NO_ELEMENT && stack_size == 0u)) {
            break;
        }
    }
    const bool is_cut_short =
        (goes_on && (element != CORE_NO_ELEMENT || stack_size > 0u)) || core_has_driver_given_up(core_size.x >> 31);

    // Beside a face that fills the pixel, or on a smooth surface, there is nothing else.
    const bool is_complete = is_usable && (is_filled || (around.is_smooth && square.all_hit));
    const bool is_contour_undecided = wants_contour && (is_contour_open || is_cut_short || !is_complete);
    const bool is_mesh_undecided = wants_mesh && (is_mesh_open || is_cut_short || !is_complete);
    const uint flags = (has_contour ? CORE_FLAG_CONTOUR : 0u) | (has_mesh_line ? CORE_FLAG_MESH_LINE : 0u) |
                       (rests_on_estimates ? CORE_FLAG_ESTIMATED : 0u);
    if (is_pixel && flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
    const uint open = (is_contour_undecided ? CORE_LIST_CONTOUR : 0u) | (is_mesh_undecided ? CORE_LIST_MESH_LINE : 0u);
    if (is_pixel && open != 0u) {
        core_open[atomicAdd(core_counts[core_open_count], 1u)] = pixel | open;
    }
    const uint all_evaluations = subgroupAdd(n_evaluations);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
    }
}
