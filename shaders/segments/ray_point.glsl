// A point of a ray in an element: at the parameter t its reference coordinates, and their change with the parameter. In scalars, since
// loops carry it.

#ifndef CORE_RAY_POINT
#define CORE_RAY_POINT

struct core_ray_point {
    elvis_real t, x, y, z, slope_x, slope_y, slope_z;
};

core_ray_point core_ray_point_at(elvis_real t, elvis_vec3 xi, elvis_vec3 slope) {
    return core_ray_point(t, xi.x, xi.y, xi.z, slope.x, slope.y, slope.z);
}

elvis_vec3 core_xi_of(const core_ray_point point) { return elvis_vec3(point.x, point.y, point.z); }
elvis_vec3 core_slope_of(const core_ray_point point) { return elvis_vec3(point.slope_x, point.slope_y, point.slope_z); }

// Where the ray is at t as predicted from there.
elvis_vec3 core_predicted(const core_ray_point point, elvis_real t) { return core_xi_of(point) + (t - point.t) * core_slope_of(point); }

// The first if `is_first`.
core_ray_point core_either(bool is_first, const core_ray_point first, const core_ray_point second) {
    return core_ray_point(is_first ? first.t : second.t, is_first ? first.x : second.x, is_first ? first.y : second.y,
                          is_first ? first.z : second.z, is_first ? first.slope_x : second.slope_x,
                          is_first ? first.slope_y : second.slope_y, is_first ? first.slope_z : second.slope_z);
}

#endif
