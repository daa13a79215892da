// A square of the picture on a tangent plane of a curved surface.

#ifndef CORE_TANGENT_SQUARE
#define CORE_TANGENT_SQUARE

#include "picture/view.glsl"

// The tangent plane; relative to the reference point.
struct core_tangent {
    elvis_vec3 point, normal;
};

// Where the ray through (column, row) meets it; t is CORE_FAR where it does not, in front of the eye.
elvis_vec3 core_tangent_point(core_tangent plane, elvis_real column, elvis_real row, out elvis_real t) {
    const core_cut_ray ray = core_cut_ray_at(column, row);
    const elvis_real slope = dot(plane.normal, ray.direction);
    const elvis_real there = dot(plane.normal, plane.point - ray.base) / slope;
    const bool is_hit = slope < elvis_real(0) && there + core_reference.w > elvis_real(0);
    t = is_hit ? there : CORE_FAR;
    return ray.base + (is_hit ? there : elvis_real(0)) * ray.direction;
}

core_cut_square core_tangent_square(core_tangent plane, core_picture_square place) {
    const elvis_real left = place.column - place.half_size, right = place.column + place.half_size;
    const elvis_real upper = place.row - place.half_size, lower = place.row + place.half_size;
    core_cut_square square;
    elvis_real t0, t1, t2, t3;
    square.corner0 = core_tangent_point(plane, left, upper, t0);
    square.corner1 = core_tangent_point(plane, right, upper, t1);
    square.corner2 = core_tangent_point(plane, left, lower, t2);
    square.corner3 = core_tangent_point(plane, right, lower, t3);
    square.all_hit = max(max(t0, t1), max(t2, t3)) < CORE_FAR;
    square.any_hit = min(min(t0, t1), min(t2, t3)) < CORE_FAR;
    const elvis_vec3 size = max(max(abs(square.corner0), abs(square.corner1)), max(abs(square.corner2), abs(square.corner3)));
    square.error = elvis_real(8) * CORE_ROUNDOFF * max(max(size.x, size.y), size.z);
    return square;
}

#endif
