// Which of the listed pixels surely meet a line, or none, on faces of one class: those that lines/face_lines.comp leaves open, at
// silhouettes and sharp edges, and where something may hide a part of the pixel.
//
// Patches of faces (boundary/face_patch.glsl) that reach into the pyramid of the pixel's rays are divided in the directions of their
// parameters. Squares are dropped that lie outside of the pyramid, and whatever is seen of those is no line if the field takes no
// isovalue on them, and they touch no edge of the face. A square that is not dropped is halved in both directions until it is
// smaller than the pixel halved core_subdivisions times; if one is left, the pixel stays undecided. What is hidden counts, too: a
// pixel may stay undecided for its sake, but is never wrong. Of a closed boundary, though, rays enter and leave the volume by
// turns: all that they meet first they enter by, or all leave by, as the pixel's own ray; squares that are met the other way are
// dropped, too.
//
// A square of the face that the pixel shows may lie inside of the pyramid as a whole, facing the viewer like the pixel's point. Then
// a line on it is met.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "element/face_frame.glsl"
#include "boundary/face_patch.glsl"
#include "tiles/hierarchy.glsl"
#include "element/place.glsl"
#include "picture/samples.glsl"
#include "lines/face_line_bindings.glsl"
#include "lines/subpixel.glsl"
#include "arithmetic/driver_limit.glsl"
#include "picture/surroundings.glsl"
#if CORE_WITH_CONTOURS
#include "field/shown_model.glsl"
#endif

#define CORE_NO_WORD 0xffffffffu
#define CORE_WORK_LIMIT 3000u
// Levels of squares: a patch of a face that fills the picture, down to parts of pixels.
#define CORE_MAX_LEVEL 15u

elvis_vec3 core_face_xi_at(core_face frame, elvis_real u, elvis_real v) {
    const elvis_real half_one = elvis_real(0.5LF);
    return frame.corner + ((u + elvis_real(1)) * half_one) * frame.a + ((v + elvis_real(1)) * half_one) * frame.b;
}

// The pyramid of a pixel's rays: the half spaces dot(normal, x - point) >= 0 of its four sides, x relative to the reference point.
// Rays of one side of the pixel lie in one plane: their bases and directions move along the same line (picture/cut_frame.glsl).
struct core_pyramid {
    elvis_vec3 left_point, left, right_point, right, upper_point, upper, lower_point, lower;
};

elvis_vec3 core_side(elvis_vec3 direction, elvis_vec3 along, elvis_vec3 inward) {
    const elvis_vec3 normal = cross(direction, along);
    return (dot(normal, inward) < elvis_real(0) ? elvis_real(-1) : elvis_real(1)) / length(normal) * normal;
}

// `t`: of a point in front of the eye.
core_pyramid core_pixel_pyramid(elvis_real column, elvis_real row, elvis_real t) {
    const elvis_real half_one = elvis_real(0.5LF);
    const core_cut_column at_left = core_cut_begin(column - half_one), at_right = core_cut_begin(column + half_one);
    const core_cut_column middle = core_cut_begin(column);
    const elvis_real down = row - middle.row0;
    const elvis_vec3 next = core_base_column.xyz + t * core_direction_column.xyz;
    const elvis_vec3 below = core_base_row.xyz + t * core_direction_row.xyz;
    core_pyramid p;
    p.left_point = (at_left.base + down * at_left.base_row).xyz;
    p.left = core_side((at_left.direction + down * at_left.direction_row).xyz, below, next);
    p.right_point = (at_right.base + down * at_right.base_row).xyz;
    p.right = core_side((at_right.direction + down * at_right.direction_row).xyz, below, -next);
    p.upper_point = (middle.base + (down - half_one) * middle.base_row).xyz;
    p.upper = core_side((middle.direction + (down - half_one) * middle.direction_row).xyz, next, below);
    p.lower_point = (middle.base + (down + half_one) * middle.base_row).xyz;
    p.lower = core_side((middle.direction + (down + half_one) * middle.direction_row).xyz, next, -below);
    return p;
}

// The largest distance that points are outside of the half space, at most: negative if all may be inside.
elvis_real core_outside_side(elvis_vec3 normal, elvis_vec3 from_point, elvis_vec3 a, elvis_vec3 b, elvis_real error) {
    return -(dot(normal, from_point) + abs(dot(normal, a)) + abs(dot(normal, b)) + error);
}

// Whether the parallelogram middle + [-1, 1] a + [-1, 1] b, but for `error`, lies outside of the pyramid for certain.
bool core_is_outside_pyramid(core_pyramid p, elvis_vec3 middle, elvis_vec3 a, elvis_vec3 b, elvis_real error) {
    return max(max(core_outside_side(p.left, middle - p.left_point, a, b, error),
                   core_outside_side(p.right, middle - p.right_point, a, b, error)),
               max(core_outside_side(p.upper, middle - p.upper_point, a, b, error),
                   core_outside_side(p.lower, middle - p.lower_point, a, b, error))) > elvis_real(0);
}

#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
// Both sides of a flat element face the viewer.
bool core_is_crossed_towards(elvis_real side, core_frame frame, int face, elvis_real change, elvis_vec3 direction) {
    return side < elvis_real(0);
}
#else
// Whether all rays of the pixel certainly leave the element by its face near a point, if `side` is 1, or enter it, if that is -1.
// `change`: by how much the Jacobian may differ there, relative to the one at the point.
bool core_is_crossed_towards(elvis_real side, core_frame frame, int face, elvis_real change, elvis_vec3 direction) {
    const elvis_vec3 outward = core_face_constraint(face).xyz;
    const elvis_vec3 ray = core_to_xi(frame, direction);
    const elvis_vec3 next = core_to_xi(frame, elvis_real(0.5LF) * core_direction_column.xyz);
    const elvis_vec3 below = core_to_xi(frame, elvis_real(0.5LF) * core_direction_row.xyz);
    const elvis_vec3 size = abs(ray) + abs(next) + abs(below);
    const elvis_real error = core_model_norm1(outward) * max(max(size.x, size.y), size.z) * change / (elvis_real(1) - change);
    const elvis_real least = side * dot(outward, ray) - abs(dot(outward, next)) - abs(dot(outward, below));
    return frame.is_sound && change < elvis_real(0.5LF) && least > error;
}
#endif

// By how much points are inside of the half space, at least.
elvis_real core_inside_side(elvis_vec3 normal, elvis_vec3 from_point, elvis_vec3 a, elvis_vec3 b, elvis_real error) {
    return dot(normal, from_point) - abs(dot(normal, a)) - abs(dot(normal, b)) - error;
}

// Whether it lies inside for certain.
bool core_is_inside_pyramid(core_pyramid p, elvis_vec3 middle, elvis_vec3 a, elvis_vec3 b, elvis_real error) {
    return min(min(core_inside_side(p.left, middle - p.left_point, a, b, error),
                   core_inside_side(p.right, middle - p.right_point, a, b, error)),
               min(core_inside_side(p.upper, middle - p.upper_point, a, b, error),
                   core_inside_side(p.lower, middle - p.lower_point, a, b, error))) > elvis_real(0);
}

bool core_box_outside_pyramid(core_pyramid p, core_node node, float error) {
    const elvis_vec3 lower = elvis_vec3(node.lower) - core_reference_in_hierarchy.xyz;
    const elvis_vec3 upper = elvis_vec3(node.upper) - core_reference_in_hierarchy.xyz;
    const elvis_vec3 middle = elvis_real(0.5LF) * (lower + upper), room = elvis_real(0.5LF) * (upper - lower);
    const elvis_real left = dot(p.left, middle - p.left_point) + dot(abs(p.left), room);
    const elvis_real right = dot(p.right, middle - p.right_point) + dot(abs(p.right), room);
    const elvis_real above = dot(p.upper, middle - p.upper_point) + dot(abs(p.upper), room);
    const elvis_real below = dot(p.lower, middle - p.lower_point) + dot(abs(p.lower), room);
    return min(min(left, right), min(above, below)) < elvis_real(-error);
}

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_pixel = i < core_first + core_n_listed;
    const uint word = core_list[is_pixel ? i : core_first];
    const uint pixel = word & CORE_LIST_PIXEL;
    const elvis_real column = elvis_real(pixel % core_size.x), row = elvis_real(pixel / core_size.x);
    const core_cut_column along = core_cut_begin(column);
    const elvis_real rows_down = row - along.row0;
    const elvis_vec3 direction = (along.direction + rows_down * along.direction_row).xyz;
    const elvis_vec3 terms = (along.size + abs(rows_down * along.base_row)).xyz + abs(core_reference_in_hierarchy.xyz);
    const elvis_real far = max(max(terms.x, terms.y), terms.z);
    // In the world, at the depth that the pixel sees.
    const elvis_real t = core_samples[pixel].depth / length(direction) - along.reference_distance;
    const core_pyramid pyramid = core_pixel_pyramid(column, row, t);
    const elvis_real pixel_size = min(length(core_base_column.xyz + t * core_direction_column.xyz),
                                      length(core_base_row.xyz + t * core_direction_row.xyz));
    const elvis_real least_size = pixel_size / elvis_real(1u << core_subdivisions);

    const core_place place = core_places[pixel];
    const bool enters = (place.class_and_face & CORE_PLACE_ENTERS) != 0u;
    const elvis_real away = enters ? elvis_real(1) : elvis_real(-1);
    core_tangent tangent;
    tangent.point = (along.base + rows_down * along.base_row).xyz + t * direction;
    tangent.normal = elvis_vec3(core_normals[3u * pixel], core_normals[3u * pixel + 1u], core_normals[3u * pixel + 2u]);
    const core_surroundings around = core_look_around(uvec2(pixel % core_size.x, pixel / core_size.x), pixel, is_pixel, tangent);
    const bool may_find = core_class_of(place) == core_class && !around.is_hidden;

    const uint known = core_marks[pixel].flags;
    bool asks_contour = is_pixel && (word & CORE_LIST_CONTOUR) != 0u && (known & CORE_FLAG_CONTOUR) == 0u;
    bool asks_mesh = is_pixel && (word & CORE_LIST_MESH_LINE) != 0u && (known & CORE_FLAG_MESH_LINE) == 0u;
    bool is_contour_open = false, is_mesh_open = false, has_contour = false, has_mesh_line = false, rests_on_estimates = false;
    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    uint stack_size = asks_contour || asks_mesh ? 1u : 0u;
    // Of the squares of one patch that are still to be looked at: level, column, row.
    uint squares[3u * CORE_MAX_LEVEL + 4u];
    uint n_squares = 0u, patch_index = 0u, work = 0u, n_evaluations = 0u;
    while ((asks_contour || asks_mesh) && (n_squares > 0u || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (n_squares == 0u && stack_size > 0u) {
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            const float size = max(max(max(abs(node.lower.x), abs(node.lower.y)), abs(node.lower.z)),
                                   max(max(abs(node.upper.x), abs(node.upper.y)), abs(node.upper.z)));
            const bool is_touched = !core_box_outside_pyramid(pyramid, node, 16.0 * CORE_FLOAT_ROUNDOFF * (float(far) + size));
            if (is_touched && !node.is_leaf) {
                stack[stack_size] = node.child + 1u;
                stack[stack_size + 1u] = node.child;
                stack_size += 2u;
            }
            patch_index = is_touched && node.is_leaf ? node.child : patch_index;
            n_squares = is_touched && node.is_leaf ? 1u : 0u;
            squares[0] = 0u;
            if (n_squares > 0u || stack_size == 0u) {
                break;
            }
        }
        const bool is_active = n_squares > 0u;
        n_squares -= is_active ? 1u : 0u;
        const uint square_word = squares[n_squares];
        const uint level = square_word & 15u, across = (square_word >> 4) & 16383u, down = square_word >> 18;
        const uvec4 more = elvis_fetch4_core_patches(patch_index, 4u);
        const core_square of_patch = core_square_of(more.w);
        const uvec4 of_face = elvis_fetch4_core_faces(more.z, 0u);
        const uint element = of_face.x;
        const core_face frame = core_face_frame(int(of_face.y));
        const elvis_real half_size = elvis_real(of_patch.size) / elvis_real(1u << level);
        const elvis_real corner_u = elvis_real(of_patch.a) - elvis_real(of_patch.size);
        const elvis_real corner_v = elvis_real(of_patch.b) - elvis_real(of_patch.size);
        const elvis_real u = corner_u + elvis_real(2u * across + 1u) * half_size;
        const elvis_real v = corner_v + elvis_real(2u * down + 1u) * half_size;
        const elvis_real half_one = elvis_real(0.5LF);
        const elvis_vec3 xi = core_face_xi_at(frame, u, v);
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(element, xi, position, jacobian);
        jacobian = core_full_jacobian(jacobian);
        n_evaluations += is_active ? 1u : 0u;
        // The square in reference coordinates; its points are off the linear image by J times the error of a Newton step.
        const elvis_vec3 a = (half_size * half_one) * frame.a, b = (half_size * half_one) * frame.b;
        const elvis_vec3 most = abs(a) + abs(b);
        const elvis_real radius = max(max(most.x, most.y), most.z) + elvis_real(8) * CORE_ROUNDOFF;
        const core_region region = core_region(-a - b, a - b, b - a, a + b, elvis_real(8) * CORE_ROUNDOFF, radius);
        const elvis_real curvature = elvis_fetch_core_curvatures(element, 0u);
        const elvis_real bend = curvature * radius * radius;
        const elvis_vec3 image_a = jacobian * a, image_b = jacobian * b;
        const elvis_vec3 shift = elvis_origin(element) - core_reference.xyz;
        const elvis_real stretch = length(jacobian[0]) + length(jacobian[1]) + length(jacobian[2]);
        const elvis_real noise = elvis_real(8) * CORE_ROUNDOFF * (far + length(shift) + length(position) + stretch);
        const elvis_vec3 middle = position + shift;
        const bool is_upper = of_patch.is_diagonal && u + v - elvis_real(2) * half_size >= elvis_real(0);
        const bool is_outside =
            is_upper || core_is_outside_pyramid(pyramid, middle, image_a, image_b, bend * stretch + noise);

        // element/prediction.glsl
        const core_frame inverse = core_frame_at(position, jacobian, noise);
        const elvis_real change =
            elvis_real(2) * curvature * radius + max(max(inverse.xi_error.x, inverse.xi_error.y), inverse.xi_error.z);
        const bool is_hidden =
            core_is_closed != 0u && core_is_crossed_towards(away, inverse, int(of_face.y), change, direction);
        const elvis_real all_error = elvis_real(2) * (bend * stretch + noise);
        const bool is_shown = may_find && element == place.element && int(of_face.y) == core_face_of(place);
        const bool is_in_front = dot(direction, middle - tangent.point) + (t + along.reference_distance) * dot(direction, direction) >
                                 length(direction) * (length(image_a) + length(image_b) + all_error);
        const bool is_seen = is_shown && is_in_front && core_is_inside_pyramid(pyramid, middle, image_a, image_b, all_error) &&
                             core_is_crossed_towards(-away, inverse, int(of_face.y), change, direction);

        // The element's own boundary is an edge, too: beyond it there is nothing of the face.
        bool is_beyond_own = false, touches_own = false, crosses_own = false;
#if ELVIS_HAS_INSIDE
        const core_inside g = core_inside_at(element, xi);
        const elvis_real along_a = abs(dot(g.slope, a)), along_b = abs(dot(g.slope, b));
        const elvis_real own_slack = core_inside_bend(g, radius) + core_model_norm1(g.slope) * region.beyond + g.rounding;
        is_beyond_own = g.value - along_a - along_b > own_slack;
        touches_own = g.value + along_a + along_b > -own_slack;
        crosses_own = g.value + along_a + along_b > own_slack && g.value - along_a - along_b < -own_slack;
#endif

        const bool is_square = is_active && !is_outside && !is_hidden && !is_beyond_own;
        const elvis_real edge = max(abs(u), abs(v)) + half_size;
        const bool touches_edge = edge >= elvis_real(1) - elvis_real(16) * CORE_ROUNDOFF ||
                                  (frame.is_triangle && u + v + elvis_real(2) * half_size >= elvis_real(-16) * CORE_ROUNDOFF);
        const bool finds_mesh = is_square && asks_mesh && is_seen && ((touches_edge && !touches_own) || crosses_own);
        const bool leaves_mesh = is_square && asks_mesh && (touches_edge || touches_own) && (is_shown || !is_mesh_open);
        bool finds_contour = false, leaves_contour = false;
#if CORE_WITH_CONTOURS
        elvis_real value;
        const core_model model = core_shown_model(element, xi, region, value);
        const core_isovalue_test test = core_test_isovalues(model, region);
        finds_contour = is_square && asks_contour && is_seen && !touches_own && test.is_met;
        leaves_contour = is_square && asks_contour && !test.is_excluded && (is_shown || !is_contour_open);
        const bool has_estimate = is_square && core_is_model_estimated(element);
        rests_on_estimates = rests_on_estimates || has_estimate;
#endif
        const bool is_small = max(length(image_a), length(image_b)) <= half_one * least_size || level >= CORE_MAX_LEVEL - 1u;
        const bool splits = (leaves_contour || leaves_mesh) && !is_small;
        is_contour_open = is_contour_open || (leaves_contour && is_small);
        is_mesh_open = is_mesh_open || (leaves_mesh && is_small);
        has_contour = has_contour || finds_contour;
        has_mesh_line = has_mesh_line || finds_mesh;
        // Only what is seen could still decide what is open.
        asks_contour = asks_contour && !finds_contour && (may_find || !is_contour_open);
        asks_mesh = asks_mesh && !finds_mesh && (may_find || !is_mesh_open);
        if (splits) {
            for (uint k = 0u; k < 4u; ++k) {
                squares[n_squares] = (level + 1u) | ((2u * across + (k & 1u)) << 4) | ((2u * down + (k >> 1)) << 18);
                n_squares += 1u;
            }
        }
        if (!(asks_contour || asks_mesh) || (n_squares == 0u && stack_size == 0u)) {
            break;
        }
    }
    const bool is_cut_short = n_squares > 0u || stack_size > 0u || core_has_driver_given_up(core_size.x >> 31);
    const bool is_contour_undecided = !has_contour && (is_contour_open || (asks_contour && is_cut_short));
    const bool is_mesh_undecided = !has_mesh_line && (is_mesh_open || (asks_mesh && is_cut_short));
    const bool is_last = core_open_count == 0u;
    const uint open = (is_contour_undecided ? CORE_LIST_CONTOUR : 0u) | (is_mesh_undecided ? CORE_LIST_MESH_LINE : 0u);
    if (is_pixel && !is_last && open != 0u) {
        core_open[atomicAdd(core_counts[core_open_count], 1u)] = pixel | open;
    }
    const uint flags = (has_contour ? CORE_FLAG_CONTOUR : 0u) | (has_mesh_line ? CORE_FLAG_MESH_LINE : 0u) |
                       (is_last && is_contour_undecided ? CORE_FLAG_CONTOUR_UNDECIDED : 0u) |
                       (is_last && is_mesh_undecided ? CORE_FLAG_MESH_UNDECIDED : 0u) |
                       (rests_on_estimates ? CORE_FLAG_ESTIMATED : 0u);
    if (is_pixel && flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
    const uint all_evaluations = subgroupAdd(n_evaluations);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
    }
}
