// Which of the listed pixels meet contours of the field, and boundaries of elements, on a cut plane.
//
// A pixel is a closed square. Each element of the class that may reach into it is asked by itself, with its own values, so that a
// jump between elements is no contour. The square is one subpixel at first; a subpixel in which the answer is open is halved in both
// directions, at most core_subdivisions times (lines/subpixel.glsl tells what is certain about a subpixel). Subpixels are visited depth
// first, in the order (0,0) (1,0) (0,1) (1,1), which needs no stack.
//
// One evaluation of mapping and field an iteration, whatever element and subpixel a lane is at.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "tiles/cut_tiles.glsl"
#include "picture/samples.glsl"
#include "tiles/hierarchy.glsl"
#include "cut_surface/cut_horizon.glsl"
#include "element/linearization.glsl"

layout(set = 0, binding = 1, std430) readonly buffer core_tiles_block { uint core_tiles[]; };
layout(set = 0, binding = 2, std430) readonly buffer core_list_block { uint core_list[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 5, std430) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };
layout(push_constant) uniform core_parameters {
    uint core_width;
    uint core_tiles_a_row;
    uint core_first;
    uint core_n_listed;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_with_mesh_lines;
    uint core_subdivisions;
};


#include "arithmetic/driver_limit.glsl"
#include "lines/subpixel.glsl"
#include "field/shown_model.glsl"

#define CORE_NO_ELEMENT 0xffffffffu
// Iterations of one pixel: far above what lines of a smooth field take, well below where drivers end loops.
#define CORE_WORK_LIMIT 2000u
// Times the mapping is linearized anew nearer to a subpixel before the subpixel is judged.
#define CORE_MAX_MOVES 8u

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = i < core_first + core_n_listed;
    const uint pixel = core_list[is_pixel ? i : core_first];
    const uint pixel_column = pixel % core_width, pixel_row = pixel / core_width;
    const uint tile = pixel_row / CORE_TILE_HEIGHT * core_tiles_a_row + pixel_column / CORE_TILE_WIDTH;
    const uint n_entries = is_pixel ? core_tiles[tile * CORE_TILE_STRIDE] : 0u;
    // Where the surface lies in faces, elements on its far side are hidden by those on the near one.
    const uint owner = core_marks[pixel].owner;
    const bool hides_behind = owner != 0u && (owner & CORE_OWNER_KEY) == 0u;

    // A box around the pixel's part of the plane.
    const core_cut_square square = core_cut_corners(elvis_real(pixel_column), elvis_real(pixel_row), elvis_real(0.5LF));
    const vec3 in_hierarchy = vec3(core_reference_in_hierarchy.xyz);
    const vec3 q0 = vec3(square.corner0) + in_hierarchy, q1 = vec3(square.corner1) + in_hierarchy;
    const vec3 q2 = vec3(square.corner2) + in_hierarchy, q3 = vec3(square.corner3) + in_hierarchy;
    const vec3 lowest = min(min(q0, q1), min(q2, q3)), highest = max(max(q0, q1), max(q2, q3));
    const vec3 size = max(abs(lowest), abs(highest)) + abs(in_hierarchy);
    const float margin = 2.0 * float(square.error) + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(size.x, size.y), size.z);
    const vec3 lower = square.all_hit ? lowest - margin : vec3(-3e38), upper = square.all_hit ? highest + margin : vec3(3e38);

    bool wants_contour = core_n_isovalues > 0u, wants_mesh = core_with_mesh_lines != 0u;
    bool is_contour_open = false, is_mesh_open = false, is_estimated = false;
    bool has_contour = false, has_mesh_line = false;
    uint stack[CORE_STACK_SIZE];
    uint stack_size = 0u, entry = 0u, element = CORE_NO_ELEMENT;
    uint level = 0u, across = 0u, down = 0u, moves = 0u, work = 0u, n_evaluations = 0u;
    elvis_real x = elvis_real(0), y = elvis_real(0), z = elvis_real(0);
    const elvis_real volume_end = core_volume_end();
    const bool is_behind =
        !square.all_hit && core_is_square_behind_volume(elvis_real(pixel_column), elvis_real(pixel_row), elvis_real(0.5LF), volume_end);
    bool goes_on = square.any_hit && !is_behind;
    while (goes_on && (element != CORE_NO_ELEMENT || stack_size > 0u || entry < n_entries) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (element == CORE_NO_ELEMENT && (stack_size > 0u || entry < n_entries)) {
            const bool is_popped = stack_size > 0u;
            const uint index = is_popped ? stack[stack_size - 1u] : core_tiles[tile * CORE_TILE_STRIDE + 1u + entry];
            stack_size -= is_popped ? 1u : 0u;
            entry += is_popped ? 0u : 1u;
            const core_node node = core_fetch_node(index);
            const bool is_touched = core_overlaps(node, lower, upper);
            element = is_touched && node.is_leaf ? node.child : CORE_NO_ELEMENT;
            if (is_touched && !node.is_leaf) {
                stack[stack_size] = node.child + 1u;
                stack[stack_size + 1u] = node.child;
                stack_size += 2u;
            }
            if (element != CORE_NO_ELEMENT) {
                const core_linearization linearization = core_fetch_linearization(element);
                const elvis_vec3 middle = elvis_real(0.25LF) * (square.corner0 + square.corner1 + square.corner2 + square.corner3);
                const elvis_vec3 target = core_reference.xyz - elvis_origin(element) + middle;
                const bool is_linearized = linearization.exponents != 0u && square.all_hit;
                const elvis_vec3 start =
                    is_linearized ? elvis_vec3(core_linear_inverse(linearization, vec3(target))) : CORE_CENTROID;
                const elvis_vec3 shift = target - middle;
                const elvis_vec3 to0 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner0))) - start);
                const elvis_vec3 to1 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner1))) - start);
                const elvis_vec3 to2 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner2))) - start);
                const elvis_vec3 to3 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner3))) - start);
                const elvis_vec3 reach = max(max(to0, to1), max(to2, to3));
                const elvis_real extent = max(max(reach.x, reach.y), reach.z);
                const bool is_skipped =
                    is_linearized && core_is_far_outside(start, extent, elvis_fetch_core_curvatures(element, 0u));
                element = is_skipped ? CORE_NO_ELEMENT : element;
                x = start.x;
                y = start.y;
                z = start.z;
                core_project(x, y, z);
                level = across = down = moves = 0u;
            }
            if (element != CORE_NO_ELEMENT || (stack_size == 0u && entry >= n_entries)) {
                break;
            }
        }

        const bool is_active = element != CORE_NO_ELEMENT;
        const uint safe_element = is_active ? element : 0u;
        const elvis_vec3 xi = elvis_vec3(x, y, z);
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(safe_element, xi, position, jacobian);
        // The subpixel is a square of the picture of this size, in pixels.
        const elvis_real cell_size = elvis_real(1) / elvis_real(1u << level);
        const elvis_real half_size = elvis_real(0.5LF) * cell_size;
        const elvis_real column = elvis_real(pixel_column) - elvis_real(0.5LF) + elvis_real(across) * cell_size + half_size;
        const elvis_real row = elvis_real(pixel_row) - elvis_real(0.5LF) + elvis_real(down) * cell_size + half_size;
        const core_cut_square part = core_cut_corners(column, row, half_size);
        const elvis_vec3 shift = core_reference.xyz - elvis_origin(safe_element);
        const elvis_vec3 origin = shift - position;
        const elvis_real error = part.error + CORE_ROUNDOFF * max(max(abs(shift.x), abs(shift.y)), abs(shift.z));
        const elvis_real curvature = elvis_fetch_core_curvatures(safe_element, 0u);
        const core_cut_point view = core_cut_pixel(core_cut_begin(column), row);
        core_subpixel subpixel = core_subpixel_at(xi, core_frame_at(position, jacobian, error), origin + part.corner0, origin + part.corner1,
                                      origin + part.corner2, origin + part.corner3, curvature, core_plane_normal.xyz,
                                      view.direction, CORE_NO_FACE);
#if ELVIS_HAS_INSIDE
        core_judge_inside(subpixel, safe_element, xi);
#endif
        elvis_real value;
        const core_model model = core_shown_model(safe_element, xi, subpixel.region, value);
        const core_isovalue_test test = core_test_isovalues(model, subpixel.region);
        n_evaluations += is_active ? 1u : 0u;

        // Nearer to the subpixel everything is known better: the point of the element that is nearest to its middle.
        const elvis_real subpixel_radius = abs(subpixel.region.radius - subpixel.region.beyond - subpixel.step);
        elvis_real near_x = subpixel.middle.x, near_y = subpixel.middle.y, near_z = subpixel.middle.z;
        core_project(near_x, near_y, near_z);
        const elvis_real move = max(max(abs(near_x - x), abs(near_y - y)), abs(near_z - z));
        const bool is_far = move > elvis_real(0.25LF) * subpixel_radius && move > elvis_real(16) * CORE_ROUNDOFF;
        const bool is_clear = !is_far && core_is_clear_of(subpixel, subpixel_radius, move, curvature);
        const bool is_outside = part.all_hit ? subpixel.is_outside || subpixel.is_grazed || is_clear || (subpixel.is_behind && hides_behind)
                                             : !part.any_hit || core_is_square_behind_volume(column, row, half_size, volume_end);
        const bool is_inside = part.all_hit && subpixel.is_inside;
        const bool moves_on = is_active && !is_outside && part.all_hit && is_far && moves < CORE_MAX_MOVES;
        moves = moves_on ? moves + 1u : 0u;

        const bool is_judged = is_active && !moves_on && !is_outside;
        const bool finds_contour = is_judged && wants_contour && is_inside && test.is_met;
        const bool finds_mesh = is_judged && wants_mesh && part.all_hit && subpixel.is_crossed;
        has_contour = has_contour || finds_contour;
        has_mesh_line = has_mesh_line || finds_mesh;
        wants_contour = wants_contour && !finds_contour;
        wants_mesh = wants_mesh && !finds_mesh;
        const bool is_excluded = part.all_hit && test.is_excluded;
        const bool leaves_contour = is_judged && wants_contour && !is_excluded;
        const bool leaves_mesh = is_judged && wants_mesh && !is_inside;
        const bool is_divided = (leaves_contour || leaves_mesh) && level < core_subdivisions;
        is_contour_open = is_contour_open || (leaves_contour && !is_divided);
        is_mesh_open = is_mesh_open || (leaves_mesh && !is_divided);
        const bool rests_on_estimates = is_judged && core_n_isovalues > 0u && core_is_model_estimated(safe_element);
        is_estimated = is_estimated || rests_on_estimates;
        goes_on = wants_contour || wants_mesh;

        // The next subpixel: below, or after this one and all that end with it.
        level += is_divided ? 1u : 0u;
        across = is_divided ? 2u * across : across;
        down = is_divided ? 2u * down : down;
        const bool is_done = is_active && !moves_on && !is_divided;
        if (is_done) {
            while (level > 0u && (across & 1u) != 0u && (down & 1u) != 0u) {
                level -= 1u;
                across >>= 1;
                down >>= 1;
            }
            const bool is_last = level == 0u;
            down += !is_last && (across & 1u) != 0u ? 1u : 0u;
            across = is_last ? 0u : across ^ 1u;
            element = is_last ? CORE_NO_ELEMENT : element;
        }
        // Where its middle is expected; on this element for the subpixel as a whole if the plane ends there.
        if (element != CORE_NO_ELEMENT) {
            const elvis_real next_size = elvis_real(1) / elvis_real(1u << level);
            const elvis_real next_column = elvis_real(pixel_column) - elvis_real(0.5LF) + (elvis_real(across) + elvis_real(0.5LF)) * next_size;
            const elvis_real next_row = elvis_real(pixel_row) - elvis_real(0.5LF) + (elvis_real(down) + elvis_real(0.5LF)) * next_size;
            const core_cut_point next = core_cut_pixel(core_cut_begin(next_column), next_row);
            const elvis_vec3 left = origin + next.position;
            const elvis_vec3 step = elvis_vec3(dot(subpixel.row0, left), dot(subpixel.row1, left), dot(subpixel.row2, left));
            const bool is_usable = next.is_hit && core_is_finite(step.x + step.y + step.z);
            elvis_real next_x = x + (is_usable ? clamp(step.x, elvis_real(-4), elvis_real(4)) : elvis_real(0));
            elvis_real next_y = y + (is_usable ? clamp(step.y, elvis_real(-4), elvis_real(4)) : elvis_real(0));
            elvis_real next_z = z + (is_usable ? clamp(step.z, elvis_real(-4), elvis_real(4)) : elvis_real(0));
            core_project(next_x, next_y, next_z);
            // Whole steps may go to and fro between points of a strongly curved element.
            const elvis_real share = moves > CORE_MAX_MOVES / 2u ? elvis_real(0.5LF) : elvis_real(1);
            x += share * (next_x - x);
            y += share * (next_y - y);
            z += share * (next_z - z);
        }
        if (!goes_on || (element == CORE_NO_ELEMENT && stack_size == 0u && entry >= n_entries)) {
            break;
        }
    }
    const bool is_cut_short = (goes_on && work >= CORE_WORK_LIMIT) || core_has_driver_given_up(core_width >> 31);

    const bool is_contour_undecided = wants_contour && (is_contour_open || is_cut_short);
    const bool is_mesh_undecided = wants_mesh && (is_mesh_open || is_cut_short);
    const uint flags = (has_contour ? CORE_FLAG_CONTOUR : 0u) | (is_contour_undecided ? CORE_FLAG_CONTOUR_UNDECIDED : 0u) |
                       (has_mesh_line ? CORE_FLAG_MESH_LINE : 0u) | (is_mesh_undecided ? CORE_FLAG_MESH_UNDECIDED : 0u) |
                       (is_estimated ? CORE_FLAG_ESTIMATED : 0u);
    if (is_pixel && flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
    const uint all_evaluations = subgroupAdd(n_evaluations);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
    }
}
