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

#include "cut_surface/surface_hit.glsl"

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
    elvis_real at_low = core_torus_p1(ray, low), at_high = core_torus_p1(ray, high);
    const bool has_zero = at_low * at_high < elvis_real(0);
    elvis_real result = abs(at_low) < abs(at_high) ? low : high;
    elvis_real size = max(high - low, elvis_real(0));
    // Illinois.
    uint step = 0u;
    while (has_zero && step < CORE_TORUS_STEPS && size > elvis_real(4) * CORE_ROUNDOFF * (abs(low) + abs(high))) {
        const elvis_real fraction = at_low / (at_low - at_high);
        // Every third step halves.
        const elvis_real middle = low + (step % 3u == 2u ? elvis_real(0.5LF) : fraction) * (high - low);
        const elvis_real value = core_torus_p1(ray, middle);
        const bool is_low = (value < elvis_real(0)) == (at_low < elvis_real(0));
        at_high = is_low ? elvis_real(0.5LF) * at_high : value;
        at_low = is_low ? value : elvis_real(0.5LF) * at_low;
        low = is_low ? middle : low;
        high = is_low ? high : middle;
        result = middle;
        size = value == elvis_real(0) ? elvis_real(0) : high - low;
        step += 1u;
    }
    return result;
}

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    core_torus_ray local;
    local.major_radius = CORE_SHAPE(0).w;
    local.minor_radius = CORE_SHAPE(1).w;
    const elvis_real size = local.major_radius + local.minor_radius;
    const elvis_mat3 to_world = elvis_mat3(CORE_SHAPE(0).xyz, CORE_SHAPE(1).xyz, CORE_SHAPE(2).xyz);
    const elvis_vec3 shifted = (ray.origin - CORE_SHAPE(3).xyz) - CORE_SHAPE(4).xyz;
    // Counted from the point nearest to the centre.
    const elvis_real speed = dot(ray.direction, ray.direction);
    const elvis_real t0 = -dot(shifted, ray.direction) / speed;
    local.origin = (shifted + t0 * ray.direction) * to_world;
    local.direction = ray.direction * to_world;
    const elvis_real noise = ray.noise + elvis_real(8) * CORE_ROUNDOFF * size;

    // Between the two crossings of the ball around all of the torus, which are equally far.
    const elvis_real reach = sqrt(max(size * size - dot(local.origin, local.origin), elvis_real(0)) / speed);
    const elvis_real margin = elvis_real(1e-3LF) * size;
    const bool is_near = dot(local.origin, local.origin) < (size + margin) * (size + margin) && ray.from < ray.to;
    const elvis_real first = max(ray.from - t0, -reach - margin), last = max(min(ray.to - t0, reach + margin), first);

    const elvis_vec2 o2 = local.origin.xy, d2 = local.direction.xy;
    const elvis_real four_squares = elvis_real(4) * local.major_radius * local.major_radius;
    local.a = dot(local.direction, local.direction);
    local.b = dot(local.origin, local.direction);
    local.c = dot(local.origin, local.origin) + (local.major_radius - local.minor_radius) * size;
    local.d = four_squares * dot(d2, d2);
    local.e = four_squares * dot(o2, d2);
    local.f = four_squares * dot(o2, o2);

    // p'' = 12 a^2 s^2 + 24 a b s + 8 b^2 + 4 a c - 2 d.
    const elvis_real k2 = elvis_real(12) * local.a * local.a, k1 = elvis_real(24) * local.a * local.b;
    const elvis_real k0 = elvis_real(8) * local.b * local.b + elvis_real(4) * local.a * local.c - elvis_real(2) * local.d;
    const elvis_real middle = -k1 / (elvis_real(2) * k2);
    const elvis_real spread = sqrt(max(middle * middle - k0 / k2, elvis_real(0)));
    const elvis_real turn0 = clamp(middle - spread, first, last), turn1 = clamp(middle + spread, first, last);

    // Ends of the monotone parts, in scalars.
    elvis_real end1 = first, end2 = first, end3 = first;
    if (is_near) {
        end1 = core_torus_extremum(local, first, turn0);
        end2 = core_torus_extremum(local, turn0, turn1);
        end3 = core_torus_extremum(local, turn1, last);
    }

    elvis_real low = first, at_low = core_torus_value(local, first);
    uint part = 0u;
    while (part < (is_near ? 4u : 0u)) {
        const elvis_real high = part == 0u ? end1 : part == 1u ? end2 : part == 2u ? end3 : last;
        const elvis_real at_high = core_torus_value(local, high);
        elvis_real a = low, b = high, at_a = at_low, at_b = at_high;
        const bool has_zero = (at_a < elvis_real(0)) != (at_b < elvis_real(0)) && a < b;
        elvis_real s = abs(at_a) < abs(at_b) ? a : b;
        elvis_real width = has_zero ? b - a : elvis_real(0);
        uint step = 0u;
        while (step < CORE_TORUS_STEPS && width > elvis_real(2) * CORE_ROUNDOFF * (abs(a) + abs(b))) {
            const elvis_real fraction = at_a / (at_a - at_b);
            const elvis_real try = a + (step % 3u == 2u ? elvis_real(0.5LF) : fraction) * (b - a);
            const elvis_real value = core_torus_value(local, try);
            const bool is_low = (value < elvis_real(0)) == (at_a < elvis_real(0));
            at_b = is_low ? elvis_real(0.5LF) * at_b : value;
            at_a = is_low ? value : elvis_real(0.5LF) * at_a;
            a = is_low ? try : a;
            b = is_low ? b : try;
            s = try;
            width = value == elvis_real(0) ? elvis_real(0) : b - a;
            step += 1u;
        }
        const elvis_vec3 y = local.origin + s * local.direction;
        const elvis_vec3 gradient = core_torus_gradient(local, y);
        const elvis_real steep = core_norm1(gradient);
        const elvis_real level_error = elvis_real(2) * noise * steep + elvis_real(16) * CORE_ROUNDOFF * local.minor_radius * local.minor_radius;
        // Along the ray; where it touches the tube, the level is quadratic in s, with half the second derivative about |d|^2.
        const elvis_real slope = abs(dot(gradient, local.direction));
        const elvis_real error = min(level_error / max(slope, elvis_real(1e-30LF)), elvis_real(2) * sqrt(level_error / local.a));
        const bool is_better = has_zero && core_is_next(ray, t0 + s, error, best);
        const elvis_vec3 normal = to_world * gradient;
        best.t = is_better ? t0 + s : best.t;
        best.error = is_better ? error : best.error;
        best.normal_x = is_better ? normal.x : best.normal_x;
        best.normal_y = is_better ? normal.y : best.normal_y;
        best.normal_z = is_better ? normal.z : best.normal_z;
        // Round the tube 1/r, round the axis |outward part of the normal| / rho.
        const elvis_real rho = max(length(y.xy), elvis_real(1e-30LF));
        const elvis_real around = length(gradient.xy) / max(length(gradient), elvis_real(1e-30LF)) / rho;
        best.bending = is_better ? max(elvis_real(1) / local.minor_radius, around) : best.bending;
        best.is_hit = best.is_hit || is_better;
        // An extremum at which rounding decides the sign.
        const bool touches = part < 3u && abs(at_high) <= level_error && high > first && high < last;
        best.is_undecided = best.is_undecided || (touches && t0 + high > ray.after && t0 + high <= best.t + best.error);
        low = high;
        at_low = at_high;
        part += 1u;
    }
    return best;
}
