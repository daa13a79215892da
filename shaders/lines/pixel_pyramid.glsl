// The pyramid of a pixel's rays, and whether parallelograms and boxes lie in it. The kernel brings tiles/hierarchy.glsl.

#include "picture/view.glsl"

// dot(normal, x - point) >= 0; x relative to the reference point.
struct core_half_space {
    elvis_vec3 point, normal;
};

struct core_pyramid {
    core_half_space left, right, upper, lower;
};

// Rays of one side of the pixel lie in one plane: their bases and directions move along the same line (picture/view.glsl).
core_half_space core_pixel_side(core_cut_ray ray, elvis_vec3 along, elvis_vec3 inward) {
    const elvis_vec3 normal = cross(ray.direction, along);
    return core_half_space(ray.base, (dot(normal, inward) < elvis_real(0) ? elvis_real(-1) : elvis_real(1)) / length(normal) * normal);
}

// `t`: of a point in front of the eye.
core_pyramid core_pixel_pyramid(elvis_real column, elvis_real row, elvis_real t) {
    const elvis_real half_one = elvis_real(0.5LF);
    const elvis_vec3 next = core_base_column.xyz + t * core_direction_column.xyz;
    const elvis_vec3 below = core_base_row.xyz + t * core_direction_row.xyz;
    return core_pyramid(core_pixel_side(core_cut_ray_at(column - half_one, row), below, next),
                        core_pixel_side(core_cut_ray_at(column + half_one, row), below, -next),
                        core_pixel_side(core_cut_ray_at(column, row - half_one), next, below),
                        core_pixel_side(core_cut_ray_at(column, row + half_one), next, -below));
}

// How deep in the half space lie at most (sign 1), or at least (sign -1), the points of the parallelogram middle + [-1, 1] a + [-1, 1] b,
// but for `error`.
elvis_real core_depth(core_half_space side, elvis_real sign, elvis_vec3 middle, elvis_vec3 a, elvis_vec3 b, elvis_real error) {
    return dot(side.normal, middle - side.point) + sign * abs(dot(side.normal, a)) + sign * abs(dot(side.normal, b)) + sign * error;
}

elvis_real core_least_depth(core_pyramid p, elvis_real sign, elvis_vec3 middle, elvis_vec3 a, elvis_vec3 b, elvis_real error) {
    return min(min(core_depth(p.left, sign, middle, a, b, error), core_depth(p.right, sign, middle, a, b, error)),
               min(core_depth(p.upper, sign, middle, a, b, error), core_depth(p.lower, sign, middle, a, b, error)));
}

elvis_real core_box_depth(core_half_space side, elvis_vec3 middle, elvis_vec3 half_size) {
    return dot(side.normal, middle - side.point) + dot(abs(side.normal), half_size);
}

bool core_box_reaches_pyramid(core_pyramid p, core_node node, float error) {
    const elvis_vec3 lower = elvis_vec3(node.lower) - core_reference_in_hierarchy.xyz;
    const elvis_vec3 upper = elvis_vec3(node.upper) - core_reference_in_hierarchy.xyz;
    const elvis_vec3 middle = elvis_real(0.5LF) * (lower + upper), half_size = elvis_real(0.5LF) * (upper - lower);
    return !(min(min(core_box_depth(p.left, middle, half_size), core_box_depth(p.right, middle, half_size)),
                 min(core_box_depth(p.upper, middle, half_size), core_box_depth(p.lower, middle, half_size))) < elvis_real(-error));
}
