// Which of the listed pixels of a shape's layer meet contours of the field and boundaries of elements; for the elements of one
// class.
//
// As lines/cut_lines.comp, on the tangent plane of the surface at the pixel's own point. What the surface departs from it is an
// error of the subpixels' corners: half the bending times the square of the distance, along the oblique ray.
//
// Where the neighbouring pixels see points near that plane, the surface is smooth. Where one of them sees a point in front of it,
// something may hide a part of the pixel; then nothing is certain. Elsewhere, at edges and silhouettes, other parts of the surface
// may show in the pixel: a line that is met is met, but that none is met rests on a plane three times the pixel's size.
//
// What then stays open is listed for the next round: after a first one without halving, which most pixels need no more than, one
// with it. On quadrics without ends the last ones (CORE_BY_QUADRIC_SPANS) look at silhouettes, too. There, a subpixel is all that its rays
// can meet of the quadric (cut_surface/quadric_span.glsl), which shrinks with the subpixel and needs no plane of the whole pixel. If the
// pixel shows the front of the quadric, then its back counts as hidden, and a line on the front is met.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "element/face_frame.glsl"
#include "element/place.glsl"
#include "picture/samples.glsl"
#include "tiles/hierarchy.glsl"
#include "element/linearization.glsl"

layout(set = 0, binding = 2, std430) readonly buffer core_normals_block { elvis_real core_normals[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 5, std430) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };
layout(set = 0, binding = 6, std430) readonly buffer core_bending_block { elvis_real core_bending[]; };
layout(set = 0, binding = 8, std430) readonly buffer core_samples_block { core_sample core_samples[]; };
// element/place.glsl
layout(set = 0, binding = 9, std430) writeonly buffer core_open_block { uint core_open[]; };
layout(set = 0, binding = 7, std430) readonly buffer core_list_block { uint core_list[]; };
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
};


#include "arithmetic/driver_limit.glsl"
#include "lines/subpixel.glsl"
#include "lines/subpixel_quadtree.glsl"
#include "picture/surroundings.glsl"
#if CORE_SHAPE_ROWS > 0
#include "cut_surface/quadric_span.glsl"
#endif
#if CORE_WITH_CONTOURS
#include "field/shown_model.glsl"
#endif

#define CORE_NO_ELEMENT 0xffffffffu
// Iterations of one pixel: far above what lines of a smooth field take, well below where drivers end loops. Near silhouettes any number
// would be used up, for which the other pixels of a group wait.
#define CORE_WORK_LIMIT (core_subdivisions <= CORE_FEW_SUBDIVISIONS ? 150u : 2000u)
#define CORE_MAX_MOVES 8u
#define CORE_ROUGH_LEVEL 2u
// Cosine of the angle below which a pixel shows so much of the surface that nothing is learned.
#define CORE_EDGE_ON elvis_real(0.06LF)

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = i < core_first + core_n_listed;
    const uint word = core_list[is_pixel ? i : core_first];
    const uint pixel = word & CORE_LIST_PIXEL;
    const uvec2 place = uvec2(pixel % core_size.x, pixel / core_size.x);
    const elvis_real column = elvis_real(place.x), row = elvis_real(place.y);
    const core_cut_column along = core_cut_begin(column);
    const elvis_real rows_down = row - along.row0;
    const elvis_vec3 direction = (along.direction + rows_down * along.direction_row).xyz;
    const elvis_real stretch = length(direction);
    core_tangent tangent;
    tangent.point = (along.base + rows_down * along.base_row).xyz +
                    (core_samples[pixel].depth / stretch - along.reference_distance) * direction;
    tangent.normal = elvis_vec3(core_normals[3u * pixel], core_normals[3u * pixel + 1u], core_normals[3u * pixel + 2u]);
    const elvis_vec3 normal = tangent.normal;
    const core_surroundings around = core_look_around(place, pixel, is_pixel, tangent);
#if CORE_BY_QUADRIC_SPANS
    const bool is_smooth = true, is_estimated = false;
    const bool is_front = core_is_quadric_front(column, row, tangent.point);
    const core_quadric_span whole = core_quadric_span_at(column, row, elvis_real(0.5LF), is_front);
    core_cut_square square;
    square.corner0 = square.corner2 = whole.from;
    square.corner1 = square.corner3 = whole.to;
    square.all_hit = whole.is_known;
    square.error = elvis_real(0);
    const elvis_real departure = whole.width;
#else
    const bool is_smooth = around.is_smooth, is_hidden = around.is_hidden;

    const core_cut_square square = core_tangent_square(tangent, column, row, is_smooth ? elvis_real(0.5LF) : elvis_real(1.5LF));
    const core_departure bent =
        core_departure_in(tangent, square, core_bending[pixel], around.turning, -dot(normal, direction) / stretch);
    const elvis_real departure = bent.distance;
    const bool is_estimated = !is_smooth || bent.is_estimated;
#endif

    const vec3 in_hierarchy = vec3(core_reference_in_hierarchy.xyz);
    const vec3 q0 = vec3(square.corner0) + in_hierarchy, q1 = vec3(square.corner1) + in_hierarchy;
    const vec3 q2 = vec3(square.corner2) + in_hierarchy, q3 = vec3(square.corner3) + in_hierarchy;
    const vec3 lowest = min(min(q0, q1), min(q2, q3)), highest = max(max(q0, q1), max(q2, q3));
    const vec3 size = max(abs(lowest), abs(highest)) + abs(in_hierarchy);
    const float margin = 2.0 * float(square.error + departure) + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(size.x, size.y), size.z);
    const vec3 lower = lowest - margin, upper = highest + margin;

    const uint known = core_marks[pixel].flags;
    bool wants_contour = (word & CORE_LIST_CONTOUR) != 0u && (known & CORE_FLAG_CONTOUR) == 0u;
    bool wants_mesh = (word & CORE_LIST_MESH_LINE) != 0u && (known & CORE_FLAG_MESH_LINE) == 0u;
#if CORE_BY_QUADRIC_SPANS
    const bool is_usable = square.all_hit;
#else
    // Where corners miss the plane, or nearly so, the surface is seen edge on.
    const bool is_edge_on = -dot(normal, direction) < CORE_EDGE_ON * stretch;
    const bool is_usable = square.all_hit && !is_hidden && !is_edge_on;
#endif
    // Where the surface is not smooth, only lines that are met are looked for, and not twice.
    const bool is_searched = is_smooth || core_subdivisions <= CORE_FEW_SUBDIVISIONS;
#if CORE_SHAPE_ROWS > 0 && !CORE_BY_QUADRIC_SPANS
    // Segments decide more.
    const bool is_left = core_subdivisions > 0u && core_is_quadric_front(column, row, tangent.point);
#else
    const bool is_left = false;
#endif
    const bool is_known = is_usable && is_searched && !is_left;
    bool is_contour_open = wants_contour && !is_known, is_mesh_open = wants_mesh && !is_known;
    bool has_contour = false, has_mesh_line = false, rests_on_estimates = false;
    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    const uint most_level = is_smooth ? core_subdivisions : min(core_subdivisions, CORE_ROUGH_LEVEL);
    uint stack_size = is_pixel && is_known ? 1u : 0u, element = CORE_NO_ELEMENT;
    uint level = 0u, across = 0u, down = 0u, moves = 0u, work = 0u, n_evaluations = 0u;
    elvis_real x = elvis_real(0), y = elvis_real(0), z = elvis_real(0);
    bool goes_on = wants_contour || wants_mesh;
    while (goes_on && (element != CORE_NO_ELEMENT || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (element == CORE_NO_ELEMENT && stack_size > 0u) {
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            const bool is_touched = core_overlaps(node, lower, upper);
            element = is_touched && node.is_leaf ? node.child : CORE_NO_ELEMENT;
            if (is_touched && !node.is_leaf) {
                stack[stack_size] = node.child + 1u;
                stack[stack_size + 1u] = node.child;
                stack_size += 2u;
            }
            if (element != CORE_NO_ELEMENT) {
                const core_linearization linearization = core_fetch_linearization(element);
                const elvis_vec3 middle =
                    CORE_BY_QUADRIC_SPANS != 0 ? elvis_real(0.5LF) * (square.corner0 + square.corner1) : tangent.point;
                const elvis_vec3 target = core_reference.xyz - elvis_origin(element) + middle;
                const bool is_linearized = linearization.exponents != 0u;
                const elvis_vec3 start =
                    is_linearized ? elvis_vec3(core_linear_inverse(linearization, vec3(target))) : CORE_CENTROID;
                const elvis_vec3 shift = target - middle;
                const elvis_vec3 to0 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner0))) - start);
                const elvis_vec3 to1 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner1))) - start);
                const elvis_vec3 to2 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner2))) - start);
                const elvis_vec3 to3 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner3))) - start);
                const elvis_vec3 reach = max(max(to0, to1), max(to2, to3));
                // Twice: what the surface departs from its tangent plane is less than the pixel's size where it is smooth.
                const elvis_real extent = elvis_real(2) * max(max(reach.x, reach.y), reach.z);
                const bool is_skipped = CORE_BY_QUADRIC_SPANS == 0 && is_linearized && is_smooth &&
                                        core_is_far_outside(start, extent, elvis_fetch_core_curvatures(element, 0u));
                element = is_skipped ? CORE_NO_ELEMENT : element;
                x = start.x;
                y = start.y;
                z = start.z;
                core_project(x, y, z);
                level = across = down = moves = 0u;
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
        // Where the surface is not smooth, one subpixel that is larger than the pixel; and the pixel in the middle of it.
        const elvis_real cell_size = core_subpixel_size(level);
        const elvis_real cell_column = core_subpixel_middle(column, across, cell_size);
        const elvis_real cell_row = core_subpixel_middle(row, down, cell_size);
        const bool is_large = !is_smooth && level == 0u;
        const elvis_vec3 shift = core_reference.xyz - elvis_origin(safe_element);
        const elvis_vec3 origin = shift - position;
#if CORE_BY_QUADRIC_SPANS
        const core_quadric_span quadric_span = core_quadric_span_at(cell_column, cell_row, elvis_real(0.5LF) * cell_size, is_front);
        const core_front front = core_quadric_front(cell_column, cell_row, elvis_real(0.5LF) * cell_size, quadric_span);
        const bool is_plane = front.is_known;
        core_cut_square part;
        part.corner0 = is_plane ? front.square.corner0 : quadric_span.from;
        part.corner1 = is_plane ? front.square.corner1 : quadric_span.to;
        part.corner2 = is_plane ? front.square.corner2 : quadric_span.from;
        part.corner3 = is_plane ? front.square.corner3 : quadric_span.to;
        part.error = is_plane ? front.square.error + front.departure : quadric_span.width;
        const bool is_absent = quadric_span.is_absent;
        // That of no face: what looks as if it lay in one may cross it.
        const int own_face = CORE_N_FACES;
        const elvis_real error = part.error + CORE_ROUNDOFF * max(max(abs(shift.x), abs(shift.y)), abs(shift.z));
#else
        const core_cut_square part =
            core_tangent_square(tangent, cell_column, cell_row, is_large ? elvis_real(1.5LF) : elvis_real(0.5LF) * cell_size);
        const bool is_plane = true, is_absent = false;
        const int own_face = CORE_NO_FACE;
        const elvis_real error = part.error + departure + CORE_ROUNDOFF * max(max(abs(shift.x), abs(shift.y)), abs(shift.z));
#endif
        const core_frame frame = core_frame_at(position, jacobian, error);
        const elvis_real curvature = elvis_fetch_core_curvatures(safe_element, 0u);
        core_subpixel subpixel = core_subpixel_at(xi, frame, origin + part.corner0, origin + part.corner1, origin + part.corner2,
                                      origin + part.corner3, curvature, normal, direction, own_face);
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
        const bool is_out = is_absent || subpixel.is_outside || (is_plane && is_clear);

        const bool is_judged = is_active && !is_out;
        bool finds_contour = false, leaves_contour = false;
#if CORE_WITH_CONTOURS
        elvis_real value;
        const core_model model = core_shown_model(safe_element, xi, subpixel.region, value);
        const core_isovalue_test test = core_test_isovalues(model, subpixel.region);
        finds_contour = is_judged && wants_contour && !is_large && is_plane && subpixel.is_inside && test.is_met;
        leaves_contour = is_judged && wants_contour && !finds_contour && !test.is_excluded;
        const bool has_estimate = is_judged && core_is_model_estimated(safe_element);
        rests_on_estimates = rests_on_estimates || has_estimate;
#endif
        const bool finds_mesh = is_judged && wants_mesh && !is_large && is_plane && subpixel.is_crossed;
        has_contour = has_contour || finds_contour;
        has_mesh_line = has_mesh_line || finds_mesh;
        wants_contour = wants_contour && !finds_contour;
        wants_mesh = wants_mesh && !finds_mesh;
        const bool leaves_mesh = is_judged && wants_mesh && !subpixel.is_inside;
        // The large subpixel is only asked whether it excludes all: what it leaves open stays so unless a line is found in the pixel.
        const bool is_left_open = leaves_contour || leaves_mesh;
        const bool moves_on = is_left_open && is_far && moves < CORE_MAX_MOVES;
        moves = moves_on ? moves + 1u : 0u;
        const bool is_divided = is_left_open && !moves_on && level < most_level;
        const bool stays_open = !moves_on && (!is_divided || is_large);
        is_contour_open = is_contour_open || (leaves_contour && stays_open);
        is_mesh_open = is_mesh_open || (leaves_mesh && stays_open);
        // A pixel that lies in one element as a whole meets no other.
        const bool is_settled = is_judged && is_smooth && level == 0u && subpixel.is_inside && !leaves_contour;
        goes_on = (wants_contour || wants_mesh) && !is_settled;

        level += is_divided ? 1u : 0u;
        across = is_divided ? 2u * across : across;
        down = is_divided ? 2u * down : down;
        const bool is_done = is_active && !moves_on && !is_divided;
        if (is_done) {
            element = core_next_subpixel(level, across, down) ? element : CORE_NO_ELEMENT;
        }
        if (element != CORE_NO_ELEMENT) {
            const elvis_real next_size = core_subpixel_size(level);
#if CORE_BY_QUADRIC_SPANS
            const core_quadric_span ahead =
                core_quadric_span_at(core_subpixel_middle(column, across, next_size), core_subpixel_middle(row, down, next_size),
                                     elvis_real(0.5LF) * next_size, is_front);
            const elvis_vec3 next = elvis_real(0.5LF) * (ahead.from + ahead.to);
#else
            elvis_real t;
            const elvis_vec3 next = core_tangent_point(
                tangent, core_subpixel_middle(column, across, next_size), core_subpixel_middle(row, down, next_size), t);
#endif
            const elvis_vec3 step = core_to_xi(frame, origin + next);
            const bool is_finite = core_is_finite(step.x + step.y + step.z);
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

    const bool is_contour_undecided = !has_contour && (is_contour_open || (wants_contour && is_cut_short));
    const bool is_mesh_undecided = !has_mesh_line && (is_mesh_open || (wants_mesh && is_cut_short));
    const bool is_last = core_open_count == 0u;
    const uint flags = (has_contour ? CORE_FLAG_CONTOUR : 0u) | (has_mesh_line ? CORE_FLAG_MESH_LINE : 0u) |
                       (is_last && is_contour_undecided ? CORE_FLAG_CONTOUR_UNDECIDED : 0u) |
                       (is_last && is_mesh_undecided ? CORE_FLAG_MESH_UNDECIDED : 0u) |
                       (is_estimated || rests_on_estimates ? CORE_FLAG_ESTIMATED : 0u);
    const uint open = (is_contour_undecided ? CORE_LIST_CONTOUR : 0u) | (is_mesh_undecided ? CORE_LIST_MESH_LINE : 0u);
    if (is_pixel && !is_last && open != 0u) {
        core_open[atomicAdd(core_counts[core_open_count], 1u)] = pixel | open;
    }
    if (is_pixel && flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
    const uint all_evaluations = subgroupAdd(n_evaluations);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
    }
}
