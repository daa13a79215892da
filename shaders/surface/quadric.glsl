// Quadrics: spheres, cylinders, cones, and all others. With CORE_HAS_ENDS only the part between two planes across the third local
// direction, closed by discs if wanted.
//
// Rows: xyz: local directions, w: q_i | xyz: anchor, a point of the surface near what is seen, w: level | xyz: linear, w: 2 max
// |q_i| | ends along the third direction, is_capped, 0. With y = local coordinates relative to the anchor the surface is
//
//     f(y) = sum q_i y_i^2 + linear . y + level = 0,
//
// scaled to a gradient of about unit length, so that a small or a distant surface, and a huge one, keep their digits: nothing
// larger than what is seen is subtracted from what is seen.
//
// The ray's parameter is counted from where f is extreme along the ray (if that is near), so that the discriminant of the quadratic
// equation is the value there and loses nothing by cancellation. One step of Newton's method removes what the root still lost.

#include "surface/hit.glsl"

struct core_quadric_point {
    elvis_real value, slope;
    elvis_vec3 y, gradient;
    // Of value.
    elvis_real error;
};

core_quadric_point core_quadric_at(elvis_vec3 origin, elvis_vec3 direction, elvis_real s, elvis_real noise) {
    const elvis_vec3 q = elvis_vec3(CORE_SHAPE(0).w, CORE_SHAPE(1).w, CORE_SHAPE(2).w);
    const elvis_vec3 linear = CORE_SHAPE(4).xyz;
    const elvis_real level = CORE_SHAPE(3).w;
    core_quadric_point point;
    point.y = origin + s * direction;
    const elvis_vec3 square = q * point.y * point.y, product = linear * point.y;
    point.value = square.x + square.y + square.z + (product.x + product.y + product.z) + level;
    point.gradient = elvis_real(2) * q * point.y + linear;
    point.slope = dot(point.gradient, direction);
    // The terms' rounding, and that of the point, which the rotation to local directions adds to.
    const elvis_real terms = core_norm1(square) + core_norm1(product) + abs(level);
    const elvis_real of_point = noise + elvis_real(4) * CORE_ROUNDOFF * (core_norm1(point.y) + abs(s) * core_norm1(direction));
    point.error = elvis_real(4) * CORE_ROUNDOFF * terms + of_point * core_norm1(point.gradient);
    return point;
}

void core_quadric_consider(core_surface_ray ray, elvis_real t0, elvis_real s, elvis_real limit, elvis_real quadratic, elvis_vec3 origin,
                           elvis_vec3 direction, inout core_hit best) {
    const elvis_real bounded = clamp(s, ray.from - t0, max(ray.to, ray.from) - t0);
    const core_quadric_point point = core_quadric_at(origin, direction, bounded, ray.noise);
    const elvis_real steep = max(abs(point.slope), elvis_real(1e-30LF));
    const elvis_real step = point.value / point.slope;
    const elvis_real t = t0 + (abs(step) <= limit ? bounded - step : bounded);
    // Where the ray touches the surface, f is quadratic in t.
    const elvis_real error = min(point.error / steep, sqrt(point.error / max(abs(quadratic), elvis_real(1e-30LF))));
    bool is_valid = bounded == s;
    best.is_undecided = best.is_undecided || (!is_valid && core_is_at_end(ray, t0 + s, error));
#if CORE_HAS_ENDS
    const elvis_vec4 ends = CORE_SHAPE(5);
    // A ray through the rim must not pass between side and cap.
    const elvis_real tolerance = elvis_real(2) * (ray.noise + error * core_norm1(direction)) +
                                 elvis_real(4) * CORE_ROUNDOFF * (abs(ends.x) + abs(ends.y) + abs(point.y.z));
    const elvis_real beyond = max(ends.x - point.y.z, point.y.z - ends.y);
    is_valid = is_valid && beyond <= tolerance;
    const bool is_uncertain = is_valid && beyond >= -tolerance;
#else
    const bool is_uncertain = false;
#endif
    const bool is_better = is_valid && core_is_next(ray, t, error, best);
    const elvis_vec3 normal = point.gradient.x * CORE_SHAPE(0).xyz + point.gradient.y * CORE_SHAPE(1).xyz +
                              point.gradient.z * CORE_SHAPE(2).xyz;
    const elvis_real bending = CORE_SHAPE(4).w / max(length(point.gradient), elvis_real(1e-30LF));
    core_take_hit(is_better, t, error, normal, min(bending, CORE_FAR), best);
    best.is_undecided = best.is_undecided || (is_better && is_uncertain);
}

#if CORE_HAS_ENDS
void core_quadric_cap(core_surface_ray ray, elvis_real t0, elvis_real end, elvis_vec3 origin, elvis_vec3 direction, inout core_hit best) {
    const elvis_real s = (end - origin.z) / direction.z;
    const elvis_real bounded = clamp(s, ray.from - t0, max(ray.to, ray.from) - t0);
    const core_quadric_point point = core_quadric_at(origin, direction, bounded, ray.noise);
    const elvis_real error = (elvis_real(2) * ray.noise + elvis_real(4) * CORE_ROUNDOFF * (abs(end) + abs(origin.z) + abs(point.y.z))) /
                             max(abs(direction.z), elvis_real(1e-30LF));
    const elvis_real tolerance = elvis_real(2) * (point.error + error * abs(point.slope));
    const bool is_valid = bounded == s && CORE_SHAPE(5).z != elvis_real(0) && point.value <= tolerance;
    const bool is_better = is_valid && core_is_next(ray, t0 + s, error, best);
    core_take_hit(is_better, t0 + s, error, CORE_SHAPE(2).xyz, elvis_real(0), best);
    best.is_undecided = best.is_undecided || (is_better && point.value >= -tolerance);
}
#endif

core_hit core_next_hit(core_surface_ray ray) {
    const elvis_vec3 shifted = ray.origin - CORE_SHAPE(3).xyz;
    const elvis_real last = max(ray.to, ray.from);
    // Nearest to the anchor, then where f is extreme.
    elvis_real t0 = clamp(-dot(shifted, ray.direction) / dot(ray.direction, ray.direction), ray.from, last);
    const elvis_vec3 start = shifted + t0 * ray.direction;
    const elvis_mat3 to_world = elvis_mat3(CORE_SHAPE(0).xyz, CORE_SHAPE(1).xyz, CORE_SHAPE(2).xyz);
    elvis_vec3 origin = start * to_world;
    const elvis_vec3 direction = ray.direction * to_world;
    const elvis_vec3 q = elvis_vec3(CORE_SHAPE(0).w, CORE_SHAPE(1).w, CORE_SHAPE(2).w);
    const elvis_real a = dot(q * direction, direction);
    const elvis_real b0 = dot(elvis_real(2) * q * origin + CORE_SHAPE(4).xyz, direction);
    // Compared with products, not quotients: a may vanish.
    const elvis_real wanted = a != elvis_real(0) ? -b0 / (elvis_real(2) * a) : elvis_real(0);
    const elvis_real shift = clamp(abs(wanted) < elvis_real(1e30LF) ? wanted : elvis_real(0), ray.from - t0, last - t0);
    origin += shift * direction;
    t0 += shift;

    const core_quadric_point middle = core_quadric_at(origin, direction, elvis_real(0), ray.noise);
    const elvis_real b = middle.slope, c = middle.value;
    const elvis_real discriminant = b * b - elvis_real(4) * a * c;
    const elvis_real discriminant_error =
        elvis_real(4) * abs(a) * middle.error + elvis_real(4) * CORE_ROUNDOFF * (b * b + elvis_real(4) * abs(a * c));
    const elvis_real root = sqrt(max(discriminant, elvis_real(0)));
    const elvis_real half_sum = elvis_real(-0.5LF) * (b + (b < elvis_real(0) ? -root : root));
    // Both roots are zero where half_sum is.
    const elvis_real s0 = a != elvis_real(0) ? half_sum / a : CORE_FAR;
    const elvis_real s1 = half_sum != elvis_real(0) ? c / half_sum : s0;
    const bool is_met = discriminant >= elvis_real(0) && ray.from <= ray.to;
    const elvis_real limit = elvis_real(0.25LF) * abs(s1 - s0);

    core_hit best = core_no_hit();
    core_quadric_consider(ray, t0, is_met ? s0 : CORE_FAR, limit, a, origin, direction, best);
    core_quadric_consider(ray, t0, is_met ? s1 : CORE_FAR, limit, a, origin, direction, best);
#if CORE_HAS_ENDS
    core_quadric_cap(ray, t0, CORE_SHAPE(5).x, origin, direction, best);
    core_quadric_cap(ray, t0, CORE_SHAPE(5).y, origin, direction, best);
#endif
    // A ray that touches the surface within rounding, unless something is before it.
    const bool touches = abs(discriminant) <= discriminant_error && ray.from < ray.to && t0 > ray.from && t0 < ray.to && t0 > ray.after;
    best.is_undecided = best.is_undecided || (touches && t0 <= best.t + best.error);
    return best;
}
