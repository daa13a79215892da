// Which pixels of a curved surface's layer meet contours of the field and boundaries of elements.
//
// As kernels/cut_lines.comp, on the tangent plane of the surface at the pixel's own point. What the surface departs from it is an
// error of the cells' corners: half the bending times the square of the distance, along the oblique ray. On faces (CORE_ON_FACES)
// the remainder of a Newton step bounds it, stretched as the ray is oblique, since the mapping and the surface are one.
//
// Where the neighbouring pixels see points near that plane, the surface is smooth. Where one of them sees a point in front of it,
// something may hide a part of the pixel; then nothing is certain. Elsewhere, at edges and silhouettes, other parts of the surface
// may show in the pixel: a line that is met is met, but that none is met rests on a plane three times the pixel's size.

layout(local_size_x = 32) in;

#include "library/precision.glsl"
#include "library/face_frame.glsl"
#include "library/samples.glsl"
#include "library/tangent_square.glsl"
#include "library/hierarchy.glsl"
#include "library/linearization.glsl"

layout(set = 0, binding = 1, std430) readonly buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) readonly buffer core_normals_block { elvis_real core_normals[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 5, std430) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };
#if !CORE_ON_FACES
layout(set = 0, binding = 6, std430) readonly buffer core_bending_block { elvis_real core_bending[]; };
#endif
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first_row;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_with_mesh_lines;
    uint core_subdivisions;
};

elvis_real core_isovalue(uint i) { return core_isovalues[i]; }

#include "library/driver_limit.glsl"
#include "library/cell.glsl"
#include "library/shown_model.glsl"

#define CORE_NO_ELEMENT 0xffffffffu
// Turns of one pixel: far above what lines of a smooth field take, well below where drivers end loops.
#define CORE_WORK_LIMIT 1500u
#define CORE_MAX_MOVES 8u
// How far neighbours may lie from the tangent plane of a smooth surface, relative to their distance.
#define CORE_SMOOTH elvis_real(0.1LF)
// Constraints of faces that may be the surface's own: how far they may be from zero, and the cosine of the least angle.
#define CORE_OWN_REACH elvis_real(0.25LF)
#define CORE_OWN_COSINE elvis_real(0.7LF)

// The face of the element in which the surface lies, at a point of the element; CORE_NO_FACE if there is none.
int core_own_face(elvis_vec3 xi, core_frame frame, elvis_vec3 normal) {
    int own = CORE_NO_FACE;
#if ELVIS_SHAPE != ELVIS_SHAPE_QUADRILATERAL && ELVIS_SHAPE != ELVIS_SHAPE_TRIANGLE
    elvis_real best = CORE_OWN_COSINE;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_real here = dot(constraint.xyz, xi) + constraint.w;
        const elvis_vec3 across = constraint.x * frame.row0 + constraint.y * frame.row1 + constraint.z * frame.row2;
        const elvis_real cosine = abs(dot(across, normal)) / length(across);
        const bool is_better = abs(here) <= CORE_OWN_REACH && cosine > best;
        own = is_better ? face : own;
        best = is_better ? cosine : best;
    }
#endif
    return own;
}

// How much farther than across the face a departure from it reaches along the ray, in the maximum norm.
elvis_real core_obliqueness(int own_face, core_frame frame, elvis_vec3 direction) {
#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    const elvis_vec3 covector = elvis_vec3(0, 0, 1);
#else
    const elvis_vec3 covector = core_face_constraint(max(own_face, 0)).xyz;
#endif
    const elvis_vec3 ray = core_to_xi(frame, direction);
    const elvis_real largest = max(max(abs(ray.x), abs(ray.y)), abs(ray.z));
    return elvis_real(1) + core_model_norm1(covector) * largest / max(abs(dot(covector, ray)), elvis_real(1e-30LF));
}

void main() {
    const uvec2 place = uvec2(gl_GlobalInvocationID.x, core_first_row + gl_WorkGroupID.y);
    const bool is_in_picture = place.x < core_size.x && place.y < core_size.y;
    const uint pixel = is_in_picture ? place.y * core_size.x + place.x : 0u;
    const bool is_pixel = is_in_picture && core_marks[pixel].owner != 0u;

    const elvis_real column = elvis_real(place.x), row = elvis_real(place.y);
    const core_cut_column along = core_cut_begin(column);
    const elvis_real rows_down = row - along.row0;
    const elvis_vec3 direction = (along.direction + rows_down * along.direction_row).xyz;
    const elvis_real stretch = length(direction);
    elvis_real depth = along.reference_distance * stretch;
    elvis_vec3 normal = -direction / stretch;
#if !CORE_ON_FACES
    elvis_real bending = elvis_real(0);
#endif
    for (uint turn = 0u; turn < (is_pixel ? 1u : 0u); ++turn) {
        depth = core_samples[pixel].depth;
        normal = elvis_vec3(core_normals[3u * pixel], core_normals[3u * pixel + 1u], core_normals[3u * pixel + 2u]);
#if !CORE_ON_FACES
        bending = core_bending[pixel];
#endif
    }
    core_tangent tangent;
    tangent.point = (along.base + rows_down * along.base_row).xyz + (depth / stretch - along.reference_distance) * direction;
    tangent.normal = normal;

    // What the neighbours see.
    bool is_smooth = true, is_hidden = false;
    elvis_real turning = elvis_real(0);
    for (uint i = 0u; i < (is_pixel ? 8u : 0u); ++i) {
        const uint k = i < 4u ? i : i + 1u;
        const ivec2 there = ivec2(place) + ivec2(int(k % 3u) - 1, int(k / 3u) - 1);
        const bool is_there = there.x >= 0 && there.y >= 0 && there.x < int(core_size.x) && there.y < int(core_size.y);
        const uint other = is_there ? uint(there.y) * core_size.x + uint(there.x) : pixel;
        const bool is_seen = core_marks[other].owner != 0u;
        const core_cut_column other_along = core_cut_begin(elvis_real(other % core_size.x));
        const elvis_real other_down = elvis_real(other / core_size.x) - other_along.row0;
        const elvis_vec3 other_direction = (other_along.direction + other_down * other_along.direction_row).xyz;
        const elvis_real t = core_samples[other].depth / length(other_direction) - other_along.reference_distance;
        const elvis_vec3 to_other =
            (other_along.base + other_down * other_along.base_row).xyz + t * other_direction - tangent.point;
        const elvis_real height = dot(normal, to_other), distance = length(to_other);
        const elvis_vec3 other_normal =
            elvis_vec3(core_normals[3u * other], core_normals[3u * other + 1u], core_normals[3u * other + 2u]);
        const bool is_near = is_seen && abs(height) <= CORE_SMOOTH * distance;
        is_smooth = is_smooth && (other == pixel || is_near);
        is_hidden = is_hidden || (other != pixel && is_seen && height > CORE_SMOOTH * distance);
        turning = other != pixel && is_near ? max(turning, length(other_normal - normal) / distance) : turning;
    }

    const core_cut_square square = core_tangent_square(tangent, column, row, is_smooth ? elvis_real(0.5LF) : elvis_real(1.5LF));
    elvis_real departure = elvis_real(0);
    bool is_estimated = !is_smooth;
#if !CORE_ON_FACES
    // Triangles are flat but not together: what normals of neighbours tell counts, too, and stands for a bending that is not known.
    const bool is_unknown = bending >= CORE_FAR;
    const elvis_real bend = max(is_unknown ? elvis_real(2) * turning : bending, turning);
    const elvis_vec3 d0 = square.corner0 - tangent.point, d1 = square.corner1 - tangent.point;
    const elvis_vec3 d2 = square.corner2 - tangent.point, d3 = square.corner3 - tangent.point;
    const elvis_real farthest = max(max(dot(d0, d0), dot(d1, d1)), max(dot(d2, d2), dot(d3, d3)));
    const elvis_real cosine = max(-dot(normal, direction) / stretch, elvis_real(1e-6LF));
    departure = elvis_real(0.5LF) * bend * farthest / cosine;
    is_estimated = is_estimated || is_unknown;
#endif

    const vec3 in_hierarchy = vec3(core_reference_in_hierarchy.xyz);
    const vec3 q0 = vec3(square.corner0) + in_hierarchy, q1 = vec3(square.corner1) + in_hierarchy;
    const vec3 q2 = vec3(square.corner2) + in_hierarchy, q3 = vec3(square.corner3) + in_hierarchy;
    const vec3 lowest = min(min(q0, q1), min(q2, q3)), highest = max(max(q0, q1), max(q2, q3));
    const vec3 size = max(abs(lowest), abs(highest)) + abs(in_hierarchy);
    // On faces, what a pixel's part of a curved one departs from its plane.
    const float margin = 2.0 * float(square.error + departure) + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(size.x, size.y), size.z) +
                         (CORE_ON_FACES != 0 ? 0.1 * length(highest - lowest) : 0.0);
    const vec3 lower = lowest - margin, upper = highest + margin;

    bool wants_contour = core_n_isovalues > 0u, wants_mesh = core_with_mesh_lines != 0u;
    // Where corners miss the plane the surface is seen edge on.
    const bool is_usable = square.all_hit && !is_hidden;
    bool is_contour_open = !is_usable, is_mesh_open = !is_usable;
    bool has_contour = false, has_mesh_line = false, rests_on_estimates = false;
    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    uint stack_size = is_pixel && is_usable ? 1u : 0u, element = CORE_NO_ELEMENT;
    uint level = 0u, across = 0u, down = 0u, moves = 0u, work = 0u, n_evaluations = 0u;
    elvis_real x = elvis_real(0), y = elvis_real(0), z = elvis_real(0);
    bool goes_on = true;
    while (goes_on && (element != CORE_NO_ELEMENT || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (element == CORE_NO_ELEMENT && stack_size > 0u) {
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            const bool is_touched = core_overlaps(node, lower, upper);
            element = is_touched && node.is_leaf ? node.child : CORE_NO_ELEMENT;
            for (uint turn = 0u; turn < (is_touched && !node.is_leaf ? 1u : 0u); ++turn) {
                stack[stack_size] = node.child + 1u;
                stack[stack_size + 1u] = node.child;
                stack_size += 2u;
            }
            for (uint turn = 0u; turn < (element != CORE_NO_ELEMENT ? 1u : 0u); ++turn) {
                const core_linearization linearization = core_fetch_linearization(element);
                const elvis_vec3 target = core_reference.xyz - elvis_origin(element) + tangent.point;
                const bool is_linearized = linearization.exponents != 0u;
                const elvis_vec3 start =
                    is_linearized ? elvis_vec3(core_linear_inverse(linearization, vec3(target))) : CORE_CENTROID;
                const elvis_vec3 shift = target - tangent.point;
                const elvis_vec3 to0 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner0))) - start);
                const elvis_vec3 to1 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner1))) - start);
                const elvis_vec3 to2 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner2))) - start);
                const elvis_vec3 to3 = abs(elvis_vec3(core_linear_inverse(linearization, vec3(shift + square.corner3))) - start);
                const elvis_vec3 reach = max(max(to0, to1), max(to2, to3));
                // Twice: what the surface departs from its tangent plane is less than the pixel's size where it is smooth.
                const elvis_real extent = elvis_real(2) * max(max(reach.x, reach.y), reach.z);
                const bool is_skipped = is_linearized && is_smooth &&
                                        core_is_far_outside(start, extent, elvis_fetch_core_curvatures(element, 0u));
                element = is_skipped ? CORE_NO_ELEMENT : element;
                x = start.x;
                y = start.y;
                z = start.z;
                core_project(x, y, z);
                level = across = down = moves = 0u;
            }
        }

        const bool is_active = element != CORE_NO_ELEMENT;
        const uint safe_element = is_active ? element : 0u;
        const elvis_vec3 xi = elvis_vec3(x, y, z);
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(safe_element, xi, position, jacobian);
        jacobian = core_full_jacobian(jacobian);
        // Where the surface is not smooth, one cell that is larger than the pixel; and the pixel in the middle of it.
        const elvis_real cell_size = elvis_real(1) / elvis_real(1u << level);
        const elvis_real cell_column = column - elvis_real(0.5LF) + (elvis_real(across) + elvis_real(0.5LF)) * cell_size;
        const elvis_real cell_row = row - elvis_real(0.5LF) + (elvis_real(down) + elvis_real(0.5LF)) * cell_size;
        const bool is_large = !is_smooth && level == 0u;
        const core_cut_square part =
            core_tangent_square(tangent, cell_column, cell_row, is_large ? elvis_real(1.5LF) : elvis_real(0.5LF) * cell_size);
        const elvis_vec3 shift = core_reference.xyz - elvis_origin(safe_element);
        const elvis_vec3 origin = shift - position;
        const elvis_real error = part.error + departure + CORE_ROUNDOFF * max(max(abs(shift.x), abs(shift.y)), abs(shift.z));
        const core_frame frame = core_frame_at(position, jacobian, error);
        elvis_real curvature = elvis_fetch_core_curvatures(safe_element, 0u);
        int own_face = CORE_NO_FACE;
        bool is_on_surface = true;
#if CORE_ON_FACES
        own_face = core_own_face(xi, frame, normal);
        curvature *= core_obliqueness(own_face, frame, direction);
#if ELVIS_SHAPE != ELVIS_SHAPE_QUADRILATERAL && ELVIS_SHAPE != ELVIS_SHAPE_TRIANGLE
        is_on_surface = own_face != CORE_NO_FACE;
#endif
#endif
        const core_cell cell = core_cell_at(xi, frame, origin + part.corner0, origin + part.corner1, origin + part.corner2,
                                            origin + part.corner3, curvature, normal, direction, own_face);
        elvis_real value;
        const core_model model = core_shown_model(safe_element, xi, cell.region, value);
        const core_level_test test = core_test_levels(model, cell.region);
        n_evaluations += is_active ? 1u : 0u;

        // Nearer to the cell everything is known better: the point of the element that is nearest to its middle.
        const elvis_real cell_radius = abs(cell.region.radius - cell.region.beyond - cell.step);
        elvis_real near_x = cell.middle.x, near_y = cell.middle.y, near_z = cell.middle.z;
        core_project(near_x, near_y, near_z);
        const elvis_real move = max(max(abs(near_x - x), abs(near_y - y)), abs(near_z - z));
        const bool is_far = move > elvis_real(0.25LF) * cell_radius && move > elvis_real(16) * CORE_ROUNDOFF;
        const bool moves_on = is_active && !cell.is_outside && is_far && moves < CORE_MAX_MOVES;
        moves = moves_on ? moves + 1u : 0u;
        const bool is_clear = !is_far && core_is_clear_of(cell, cell_radius, move, elvis_fetch_core_curvatures(safe_element, 0u));
        const bool is_out = cell.is_outside || is_clear || !is_on_surface;

        const bool is_judged = is_active && !moves_on && !is_out;
        const bool finds_contour = is_judged && wants_contour && !is_large && cell.is_inside && test.is_met;
        const bool finds_mesh = is_judged && wants_mesh && !is_large && cell.is_crossed;
        has_contour = has_contour || finds_contour;
        has_mesh_line = has_mesh_line || finds_mesh;
        wants_contour = wants_contour && !finds_contour;
        wants_mesh = wants_mesh && !finds_mesh;
        const bool leaves_contour = is_judged && wants_contour && !test.is_excluded;
        const bool leaves_mesh = is_judged && wants_mesh && !cell.is_inside;
        // The large cell is only asked whether it excludes all: what it leaves open stays so unless a line is found in the pixel.
        const bool is_divided = (leaves_contour || leaves_mesh) && level < core_subdivisions;
        is_contour_open = is_contour_open || (leaves_contour && (!is_divided || is_large));
        is_mesh_open = is_mesh_open || (leaves_mesh && (!is_divided || is_large));
        const bool has_estimate = is_judged && core_n_isovalues > 0u && core_is_model_estimated(safe_element);
        rests_on_estimates = rests_on_estimates || has_estimate;
        // A pixel that lies in one element as a whole meets no other.
        const bool is_settled = is_judged && is_smooth && level == 0u && cell.is_inside && !leaves_contour;
        goes_on = (wants_contour || wants_mesh) && !is_settled;

        level += is_divided ? 1u : 0u;
        across = is_divided ? 2u * across : across;
        down = is_divided ? 2u * down : down;
        const bool is_done = is_active && !moves_on && !is_divided;
        for (uint turn = 0u; turn < (is_done ? 1u : 0u); ++turn) {
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
        for (uint turn = 0u; turn < (element != CORE_NO_ELEMENT ? 1u : 0u); ++turn) {
            const elvis_real next_size = elvis_real(1) / elvis_real(1u << level);
            elvis_real t;
            const elvis_vec3 next = core_tangent_point(
                tangent, column - elvis_real(0.5LF) + (elvis_real(across) + elvis_real(0.5LF)) * next_size,
                row - elvis_real(0.5LF) + (elvis_real(down) + elvis_real(0.5LF)) * next_size, t);
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
    }
    const bool is_cut_short =
        (goes_on && (element != CORE_NO_ELEMENT || stack_size > 0u)) || core_has_driver_given_up(core_size.x >> 31);

    const bool is_contour_undecided = wants_contour && (is_contour_open || is_cut_short);
    const bool is_mesh_undecided = wants_mesh && (is_mesh_open || is_cut_short);
    const uint flags = (has_contour ? CORE_FLAG_CONTOUR : 0u) | (is_contour_undecided ? CORE_FLAG_CONTOUR_UNDECIDED : 0u) |
                       (has_mesh_line ? CORE_FLAG_MESH_LINE : 0u) | (is_mesh_undecided ? CORE_FLAG_MESH_UNDECIDED : 0u) |
                       (is_estimated || rests_on_estimates ? CORE_FLAG_ESTIMATED : 0u);
    for (uint turn = 0u; turn < (is_pixel && flags != 0u ? 1u : 0u); ++turn) {
        core_marks[pixel].flags |= flags;
    }
    const uint all_evaluations = subgroupAdd(n_evaluations);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
    }
}
