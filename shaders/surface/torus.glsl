// Tori: the points at distance r (minor radius) from a circle of radius R (major radius).
//
// Rows: xyz: first local direction, w: R | second direction, w: r | axis | centre, rounded | what the rounding left of the centre.
//
// In local coordinates y relative to the centre, with distance rho from the axis and height h, the ray's points satisfy
//
//     p(s) = (|y|^2 + R^2 - r^2)^2 - 4 R^2 rho^2 = 0,
//
// a quartic in s. A quartic is monotone between the zeros of its derivative, these lie one each between those of the second
// derivative, and these are known: so all zeros are enclosed, and none is missed. The quartic decides where to look only: signs,
// and zeros, are those of
//
//     e(s) = (rho - R)^2 + h^2 - r^2,
//
// the factor of p = e ((rho + R)^2 + h^2 - r^2) that belongs to the surface, about 2 r times the distance from it, which loses no
// digits. For a spindle torus (r > R) the other factor vanishes on the inner part, and p is taken itself.

#include "surface/hit.glsl"
#include "surface/illinois.glsl"

#define CORE_TORUS_STEPS 60

struct core_torus_ray {
    // Of the quartic p(s) = ((a s + 2 b) s + c)^2 - (d s + 2 e) s - f, all along the ray from `origin`.
    elvis_real a, b, c, d, e, f;
    elvis_vec3 origin, direction;
    elvis_real major_radius, minor_radius;
};

elvis_real core_torus_p1(core_torus_ray ray, elvis_real s) {
    const elvis_real square = (ray.a * s + elvis_real(2) * ray.b) * s + ray.c;
    return elvis_real(4) * square * (ray.a * s + ray.b) - elvis_real(2) * (ray.d * s + ray.e);
}

// About 2 r times the distance from the surface; and how it changes with the point, and what it loses by rounding if the point has
// `noise`.
elvis_real core_torus_value(core_torus_ray ray, elvis_real s) {
    const elvis_vec3 y = ray.origin + s * ray.direction;
    const elvis_real rho = length(y.xy);
    const elvis_real near = rho - ray.major_radius, far = rho + ray.major_radius;
    const elvis_real outer = near * near + (y.z - ray.minor_radius) * (y.z + ray.minor_radius);
    const elvis_real inner = far * far + (y.z - ray.minor_radius) * (y.z + ray.minor_radius);
    return ray.minor_radius > ray.major_radius ? outer * (inner / (far * far)) : outer;
}

elvis_vec3 core_torus_gradient(core_torus_ray ray, elvis_vec3 y) {
    const elvis_real rho = length(y.xy);
    const elvis_vec2 outward = y.xy / max(rho, elvis_real(1e-30LF));
    // On the inner part of a spindle torus the circle's far side is at distance r.
    const elvis_real outer = (rho - ray.major_radius) * (rho - ray.major_radius) + y.z * y.z - ray.minor_radius * ray.minor_radius;
    const elvis_real inner = (rho + ray.major_radius) * (rho + ray.major_radius) + y.z * y.z - ray.minor_radius * ray.minor_radius;
    const elvis_real from_circle = abs(inner) < abs(outer) ? rho + ray.major_radius : rho - ray.major_radius;
    return elvis_vec3(elvis_real(2) * from_circle * outward, elvis_real(2) * y.z);
}

// A zero of the derivative between two points where its signs differ, or else the end where it is nearer to zero.
elvis_real core_torus_extremum(core_torus_ray ray, elvis_real low, elvis_real high) {
    core_bracket bracket = core_bracket(low, high, core_torus_p1(ray, low), core_torus_p1(ray, high));
    const bool has_zero = bracket.at_low * bracket.at_high < elvis_real(0);
    elvis_real result = core_better_end(bracket);
    elvis_real size = max(high - low, elvis_real(0));
    uint step = 0u;
    while (has_zero && step < CORE_TORUS_STEPS && size > elvis_real(4) * CORE_ROUNDOFF * (abs(bracket.low) + abs(bracket.high))) {
        result = core_next_place(bracket, step, core_secant_fraction(bracket));
        const elvis_real value = core_torus_p1(ray, result);
        core_take_value(result, value, bracket);
        size = value == elvis_real(0) ? elvis_real(0) : bracket.high - bracket.low;
        step += 1u;
    }
    return result;
}

// A zero of the surface's function between two points where its signs differ, or else the end where it is nearer to zero.
elvis_real core_torus_zero(core_torus_ray ray, core_bracket bracket, bool has_zero) {
    elvis_real result = core_better_end(bracket);
    elvis_real size = has_zero ? bracket.high - bracket.low : elvis_real(0);
    uint step = 0u;
    while (step < CORE_TORUS_STEPS && size > elvis_real(2) * CORE_ROUNDOFF * (abs(bracket.low) + abs(bracket.high))) {
        result = core_next_place(bracket, step, core_secant_fraction(bracket));
        const elvis_real value = core_torus_value(ray, result);
        core_take_value(result, value, bracket);
        size = value == elvis_real(0) ? elvis_real(0) : bracket.high - bracket.low;
        step += 1u;
    }
    return result;
}

// The ray in local coordinates, counted from `t0` on, where it is nearest to the centre.
core_torus_ray core_torus_ray_of(core_surface_ray ray, elvis_mat3 to_world, out elvis_real t0) {
    core_torus_ray local;
    local.major_radius = CORE_SHAPE(0).w;
    local.minor_radius = CORE_SHAPE(1).w;
    const elvis_vec3 shifted = (ray.origin - CORE_SHAPE(3).xyz) - CORE_SHAPE(4).xyz;
    t0 = -dot(shifted, ray.direction) / dot(ray.direction, ray.direction);
    local.origin = (shifted + t0 * ray.direction) * to_world;
    local.direction = ray.direction * to_world;
    const elvis_vec2 o2 = local.origin.xy, d2 = local.direction.xy;
    const elvis_real four_squares = elvis_real(4) * local.major_radius * local.major_radius;
    local.a = dot(local.direction, local.direction);
    local.b = dot(local.origin, local.direction);
    local.c = dot(local.origin, local.origin) +
              (local.major_radius - local.minor_radius) * (local.major_radius + local.minor_radius);
    local.d = four_squares * dot(d2, d2);
    local.e = four_squares * dot(o2, d2);
    local.f = four_squares * dot(o2, o2);
    return local;
}

// Ends of the four intervals, some of them empty, on which the quartic is monotone; in scalars.
struct core_torus_intervals {
    elvis_real first, end0, end1, end2, last;
    // The ray comes near the torus.
    bool is_near;
};

core_torus_intervals core_torus_intervals_of(core_torus_ray local, core_surface_ray ray, elvis_real t0) {
    // Between the two crossings of the ball around all of the torus, which are equally far.
    const elvis_real size = local.major_radius + local.minor_radius, speed = dot(ray.direction, ray.direction);
    const elvis_real reach = sqrt(max(size * size - dot(local.origin, local.origin), elvis_real(0)) / speed);
    const elvis_real margin = elvis_real(1e-3LF) * size;
    core_torus_intervals intervals;
    intervals.is_near = dot(local.origin, local.origin) < (size + margin) * (size + margin) && ray.from < ray.to;
    intervals.first = max(ray.from - t0, -reach - margin);
    intervals.last = max(min(ray.to - t0, reach + margin), intervals.first);
    // p'' = 12 a^2 s^2 + 24 a b s + 8 b^2 + 4 a c - 2 d.
    const elvis_real k2 = elvis_real(12) * local.a * local.a, k1 = elvis_real(24) * local.a * local.b;
    const elvis_real k0 = elvis_real(8) * local.b * local.b + elvis_real(4) * local.a * local.c - elvis_real(2) * local.d;
    const elvis_real middle = -k1 / (elvis_real(2) * k2);
    const elvis_real spread = sqrt(max(middle * middle - k0 / k2, elvis_real(0)));
    const elvis_real zero0 = clamp(middle - spread, intervals.first, intervals.last);
    const elvis_real zero1 = clamp(middle + spread, intervals.first, intervals.last);
    intervals.end0 = intervals.end1 = intervals.end2 = intervals.first;
    if (intervals.is_near) {
        intervals.end0 = core_torus_extremum(local, intervals.first, zero0);
        intervals.end1 = core_torus_extremum(local, zero0, zero1);
        intervals.end2 = core_torus_extremum(local, zero1, intervals.last);
    }
    return intervals;
}

// What a point of the ray tells as a crossing.
struct core_torus_point {
    elvis_vec3 gradient;
    elvis_real value_error, error, bending;
};

core_torus_point core_torus_point_at(core_torus_ray local, elvis_real s, elvis_real noise) {
    const elvis_vec3 y = local.origin + s * local.direction;
    core_torus_point point;
    point.gradient = core_torus_gradient(local, y);
    point.value_error = elvis_real(2) * noise * core_norm1(point.gradient) +
                        elvis_real(16) * CORE_ROUNDOFF * local.minor_radius * local.minor_radius;
    // Along the ray; where it touches the tube, the value is quadratic in s, with half the second derivative about |d|^2.
    const elvis_real slope = abs(dot(point.gradient, local.direction));
    point.error = min(point.value_error / max(slope, elvis_real(1e-30LF)), elvis_real(2) * sqrt(point.value_error / local.a));
    // Round the tube 1/r, round the axis |outward part of the normal| / rho.
    const elvis_real rho = max(length(y.xy), elvis_real(1e-30LF));
    const elvis_real around = length(point.gradient.xy) / max(length(point.gradient), elvis_real(1e-30LF)) / rho;
    point.bending = max(elvis_real(1) / local.minor_radius, around);
    return point;
}

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const elvis_mat3 to_world = elvis_mat3(CORE_SHAPE(0).xyz, CORE_SHAPE(1).xyz, CORE_SHAPE(2).xyz);
    elvis_real t0;
    const core_torus_ray local = core_torus_ray_of(ray, to_world, t0);
    const core_torus_intervals intervals = core_torus_intervals_of(local, ray, t0);
    const elvis_real noise = ray.noise + elvis_real(8) * CORE_ROUNDOFF * (local.major_radius + local.minor_radius);
    elvis_real low = intervals.first, at_low = core_torus_value(local, low);
    uint interval = 0u;
    while (interval < (intervals.is_near ? 4u : 0u)) {
        const elvis_real high = interval == 0u   ? intervals.end0
                                : interval == 1u ? intervals.end1
                                : interval == 2u ? intervals.end2
                                                 : intervals.last;
        const elvis_real at_high = core_torus_value(local, high);
        const core_bracket bracket = core_bracket(low, high, at_low, at_high);
        const bool has_zero = core_has_sign_change(bracket) && low < high;
        const elvis_real s = core_torus_zero(local, bracket, has_zero);
        const core_torus_point point = core_torus_point_at(local, s, noise);
        const bool is_better = has_zero && core_is_next(ray, t0 + s, point.error, best);
        core_take_hit(is_better, t0 + s, point.error, to_world * point.gradient, point.bending, best);
        // An extremum at which rounding decides the sign.
        const bool touches = interval < 3u && abs(at_high) <= point.value_error && high > intervals.first && high < intervals.last;
        best.is_undecided = best.is_undecided || (touches && t0 + high > ray.after && t0 + high <= best.t + best.error);
        low = high;
        at_low = at_high;
        interval += 1u;
    }
    return best;
}
