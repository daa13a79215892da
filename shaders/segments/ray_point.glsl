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

// By the cubic through two points and their slopes, between them or not much farther beyond `known` than they are apart; else along
// the slope at `known`.
elvis_vec3 core_predicted_by_two(const core_ray_point known, const core_ray_point before, elvis_real at) {
    const elvis_real since = at - known.t, width = before.t - known.t;
    const bool is_near = (since - width) * (since + elvis_real(1.5LF) * width) < elvis_real(0);
    const elvis_real t = is_near ? since / width : elvis_real(0), s = elvis_real(1) - t;
    const elvis_real of_before = t * t * (elvis_real(3) - elvis_real(2) * t), of_slope = is_near ? width * t * s * s : since;
    const elvis_real of_slope_before = -width * t * t * s;
    return core_xi_of(known) + of_before * (core_xi_of(before) - core_xi_of(known)) + of_slope * core_slope_of(known) +
           of_slope_before * core_slope_of(before);
}

// Where the cubic meets the plane, from `near` on by Newton's method; `near` itself where there is no cubic.
elvis_real core_crossing_by_two(const core_ray_point known, const core_ray_point before, elvis_vec4 plane, elvis_real near) {
    const elvis_real width = before.t - known.t, inverse = elvis_real(1) / width;
    const elvis_real value = dot(plane.xyz, core_xi_of(known)) + plane.w, slope = dot(plane.xyz, core_slope_of(known));
    const elvis_real slope_before = dot(plane.xyz, core_slope_of(before));
    const elvis_real mean = (dot(plane.xyz, core_xi_of(before)) + plane.w - value) * inverse;
    const elvis_real square = (elvis_real(3) * mean - elvis_real(2) * slope - slope_before) * inverse;
    const elvis_real cubic = (slope + slope_before - elvis_real(2) * mean) * inverse * inverse;
    elvis_real since = near - known.t;
    const bool is_near = (since - width) * (since + elvis_real(1.5LF) * width) < elvis_real(0);
    for (int i = 0; i < 2; ++i) {
        const elvis_real rate = slope + since * (elvis_real(2) * square + since * elvis_real(3) * cubic);
        since -= (value + since * (slope + since * (square + since * cubic))) / rate;
    }
    return is_near && core_is_finite(since) ? known.t + since : near;
}

// The first if `is_first`.
core_ray_point core_either(bool is_first, const core_ray_point first, const core_ray_point second) {
    return core_ray_point(is_first ? first.t : second.t, is_first ? first.x : second.x, is_first ? first.y : second.y,
                          is_first ? first.z : second.z, is_first ? first.slope_x : second.slope_x,
                          is_first ? first.slope_y : second.slope_y, is_first ? first.slope_z : second.slope_z);
}

#endif
