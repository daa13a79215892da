// Ribbons along curves, in pieces that are bilinear patches: descent through a hierarchy, nearest boxes first, and the crossings of a piece
// in closed form, as in A. Reshetov, "Cool patches: a geometric approach to ray/bilinear patch intersections" (Ray Tracing Gems, 2019).
// The piece is moved so that the ray's nearest point to its middle is the origin, which keeps the digits of small pieces, and sheared so
// that the ray becomes an axis. Across the ray the line at u, from a + u (b - a) to c + u (d - c), meets the ray where the two ends and the
// origin are on one line: a quadratic equation.
//
// Rows: xyz: reference point minus the origin of pieces and hierarchy.
//
// Buffers: core_ribbons, twelve numbers each: two points across the curve where the piece begins, two where it ends; core_nodes.

#include "surface/descent.glsl"
#include "surface/shear.glsl"

// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 3000u

struct core_ribbon {
    // Corners, relative to origin + t0 direction of the ray.
    elvis_vec3 a, b, c, d;
    elvis_real t0;
    // Of distances.
    elvis_real error;
};

core_ribbon core_fetch_ribbon(uint index, core_surface_ray ray, elvis_vec3 origin) {
    const elvis_vec4 row0 = elvis_fetch4_core_ribbons(index, 0u), row1 = elvis_fetch4_core_ribbons(index, 1u);
    const elvis_vec4 row2 = elvis_fetch4_core_ribbons(index, 2u);
    const elvis_vec3 a = row0.xyz, b = elvis_vec3(row0.w, row1.xy), c = elvis_vec3(row1.zw, row2.x), d = row2.yzw;
    core_ribbon ribbon;
    const elvis_vec3 away = origin - elvis_real(0.25LF) * (a + b + c + d);
    ribbon.t0 = -dot(away, ray.direction) / dot(ray.direction, ray.direction);
    const elvis_vec3 here = origin + ribbon.t0 * ray.direction;
    ribbon.a = a - here;
    ribbon.b = b - here;
    ribbon.c = c - here;
    ribbon.d = d - here;
    ribbon.error = elvis_real(4) * ray.noise + elvis_real(16) * CORE_ROUNDOFF * (core_norm1(away) + core_norm1(a) + core_norm1(d));
    return ribbon;
}

elvis_real core_across(elvis_vec3 p, elvis_vec3 q) { return p.x * q.y - p.y * q.x; }

// Corners in sheared coordinates; and the equation's Bernstein coefficients, and what rounding may make of them.
struct core_sheared_ribbon {
    elvis_vec3 a, b, c, d;
    elvis_real first, middle, last, error;
};

core_sheared_ribbon core_shear_ribbon(core_ribbon ribbon, core_shear shear) {
    core_sheared_ribbon result;
    result.a = core_sheared(shear, ribbon.a);
    result.b = core_sheared(shear, ribbon.b);
    result.c = core_sheared(shear, ribbon.c);
    result.d = core_sheared(shear, ribbon.d);
    result.first = core_across(result.a, result.c);
    result.middle = elvis_real(0.5LF) * (core_across(result.a, result.d) + core_across(result.b, result.c));
    result.last = core_across(result.b, result.d);
    const elvis_real size = max(max(core_norm1(elvis_vec3(result.a.xy, 0)), core_norm1(elvis_vec3(result.b.xy, 0))),
                                max(core_norm1(elvis_vec3(result.c.xy, 0)), core_norm1(elvis_vec3(result.d.xy, 0))));
    result.error = elvis_real(2) * (ribbon.error + elvis_real(4) * CORE_ROUNDOFF * size) * size;
    return result;
}

// The crossing near u, of which Newton's method takes the last digits.
void core_consider_root(core_ribbon ribbon, core_sheared_ribbon sheared, elvis_real u, bool is_root, core_surface_ray ray, core_shear shear,
                        inout core_votes votes, inout core_hit best) {
    const elvis_real one = elvis_real(1), zero = elvis_real(0);
    const elvis_vec3 ab = sheared.b - sheared.a, cd = sheared.d - sheared.c;
    elvis_vec3 from = sheared.a + u * ab, to = sheared.c + u * cd, along = to - from;
    elvis_real square = along.x * along.x + along.y * along.y;
    elvis_real v = square > zero ? -(from.x * along.x + from.y * along.y) / square : zero;
    elvis_vec3 across = (one - v) * ab + v * cd;
    elvis_real area = core_across(across, along);
    u -= area != zero ? core_across(from, along) / area : zero;
    from = sheared.a + u * ab;
    to = sheared.c + u * cd;
    along = to - from;
    square = along.x * along.x + along.y * along.y;
    v = square > zero ? -(from.x * along.x + from.y * along.y) / square : zero;
    across = (one - v) * ab + v * cd;
    area = core_across(across, along);

    const elvis_real off = ribbon.error / max(abs(area), elvis_real(1e-30LF));
    const elvis_real error_u = off * (abs(along.x) + abs(along.y)), error_v = off * (abs(across.x) + abs(across.y));
    const elvis_real inside_u = min(u, one - u), inside_v = min(v, one - v);
    const bool is_within = inside_u >= zero && inside_v >= zero;
    const bool is_near = inside_u >= -error_u && inside_v >= -error_v;
    const bool is_clear = inside_u >= error_u && inside_v >= error_v;
    const elvis_vec3 across_3 = (one - v) * (ribbon.b - ribbon.a) + v * (ribbon.d - ribbon.c);
    const elvis_vec3 along_3 = (one - u) * (ribbon.c - ribbon.a) + u * (ribbon.d - ribbon.b);
    const elvis_vec3 normal = cross(across_3, along_3);
    const elvis_real slope = abs(dot(normal, ray.direction));
    const elvis_real t = ribbon.t0 + ((one - v) * from.z + v * to.z) * shear.scale;
    const elvis_real error = ribbon.error * core_norm1(normal) / max(slope, elvis_real(1e-30LF) * core_norm1(normal));
    const bool counts = is_root && area != zero && is_near && core_is_counted(ray, t, error, best);
    const bool is_better = core_vote(votes, best, t, error, is_within, is_clear, area < zero, counts);
    core_take_hit(is_better, t, error, normal, CORE_FAR, best);
}

// Whether the ray passes so close to the piece's outline, or lies so nearly in it, that rounding decides.
bool core_touches(core_ribbon ribbon, core_sheared_ribbon sheared, elvis_real room, elvis_real curve, core_surface_ray ray,
                  core_shear shear, core_hit best) {
    const elvis_real zero = elvis_real(0), one = elvis_real(1);
    const elvis_real largest = max(max(abs(sheared.first), abs(sheared.middle)), abs(sheared.last));
    const bool lies_in = largest <= sheared.error;
    const bool is_double = abs(room) <= elvis_real(4) * sheared.error * (largest + sheared.error);
    const elvis_real u = curve != zero ? (sheared.first - sheared.middle) / curve : zero;
    const elvis_vec3 from = sheared.a + u * (sheared.b - sheared.a), along = sheared.c + u * (sheared.d - sheared.c) - from;
    const elvis_real square = along.x * along.x + along.y * along.y;
    const elvis_real v = square > zero ? -(from.x * along.x + from.y * along.y) / square : zero;
    const bool is_inside = u >= zero && u <= one && v >= zero && v <= one;
    const elvis_real low = min(min(sheared.a.z, sheared.b.z), min(sheared.c.z, sheared.d.z)) * shear.scale;
    const elvis_real high = max(max(sheared.a.z, sheared.b.z), max(sheared.c.z, sheared.d.z)) * shear.scale;
    const elvis_real near = ribbon.t0 + min(low, high), far = ribbon.t0 + max(low, high);
    return (lies_in || (is_double && is_inside)) && far > max(ray.from, ray.after) && near < ray.to && near <= best.t + best.error;
}

void core_consider_ribbon(core_ribbon ribbon, bool is_active, core_surface_ray ray, core_shear shear, inout core_votes votes,
                          inout core_hit best) {
    const core_sheared_ribbon sheared = core_shear_ribbon(ribbon, shear);
    const elvis_real zero = elvis_real(0), difference = sheared.first - sheared.middle;
    const elvis_real curve = difference + (sheared.last - sheared.middle);
    const elvis_real room = sheared.middle * sheared.middle - sheared.first * sheared.last;
    // Of the two solutions that which is not a small difference of large numbers, and the other by their product.
    const elvis_real root = sqrt(max(room, zero));
    const elvis_real sum = difference + (difference < zero ? -root : root);
    uint solution = 0u;
    while (solution < 2u) {
        const elvis_real above = solution == 0u ? sum : sheared.first, below = solution == 0u ? curve : sum;
        const bool is_root = is_active && room >= zero && abs(above) < elvis_real(4) * abs(below);
        core_consider_root(ribbon, sheared, is_root ? above / below : zero, is_root, ray, shear, votes, best);
        solution += 1u;
    }
    best.is_undecided = best.is_undecided || (is_active && core_touches(ribbon, sheared, room, curve, ray, shear, best));
}

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const elvis_vec3 origin = ray.origin + CORE_SHAPE(0).xyz;
    const core_shear shear = core_shear_of(ray.direction);
    const core_box_ray box_ray = core_make_box_ray(ray, origin, CORE_SHAPE(0).xyz);
    core_stack[0] = 0u;
    uint stack_size = ray.from < ray.to ? 1u : 0u;
    uint work = 0u;
    core_votes votes = core_no_votes();
    while (stack_size > 0u && work < CORE_WORK_LIMIT) {
        work += 1u;
        const uint item = core_next_item(box_ray, float(best.t + best.error), stack_size);
        const bool is_active = item != CORE_NO_NODE;
        core_consider_ribbon(core_fetch_ribbon(is_active ? item : 0u, ray, origin), is_active, ray, shear, votes, best);
    }
    best.is_undecided = best.is_undecided || core_is_undecided(votes, best);
    best.is_cut_short = stack_size > 0u;
    return best;
}
