// The pyramid of a pixel's rays, and whether parallelograms and boxes lie in it. The kernel brings tiles/hierarchy.glsl.

#include "picture/cut_frame.glsl"

// The half spaces dot(normal, x - point) >= 0 of its four sides, x relative to the reference point.
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
