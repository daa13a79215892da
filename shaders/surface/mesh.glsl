// Meshes of triangles: descent through a hierarchy, nearest boxes first, and the watertight test of S. Woop, C. Benthin, I. Wald,
// "Watertight ray/triangle intersection" (2013): corners are sheared so that the ray becomes an axis, each corner in the same way
// whatever triangle it belongs to; the signs of the three edge functions are exact for these numbers, and a ray through an edge
// belongs to both sides. So no ray passes between triangles that share their corners.
//
// Rows: xyz: reference point minus the origin of corners and hierarchy.
//
// Buffers: core_triangles, nine numbers each; core_nodes.

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "surface/descent.glsl"
#include "surface/shear.glsl"

// Cosine of the angle, and distance over the pixel's size, within which triangles are one sheet.
#define CORE_SAME_SHEET elvis_real(0.97LF)
#define CORE_SHEET_ROOM elvis_real(0.5LF)

// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 3000u

// The sign, exact, of a b - c d; times its rounded value.
elvis_real core_edge_function(elvis_real a, elvis_real b, elvis_real c, elvis_real d) {
    precise const elvis_real p = a * b;
    precise const elvis_real q = c * d;
    precise elvis_real result = p - q;
    // Rounding keeps order: only equal products hide a sign.
    if (result == elvis_real(0)) {
        elvis_real p0, p_error, q0, q_error;
        core_two_product(a, b, p0, p_error);
        core_two_product(c, d, q0, q_error);
        result = p_error - q_error;
    }
    return result;
}

// Relative to the ray's origin.
struct core_triangle {
    elvis_vec3 a, b, c;
};

core_triangle core_triangle_from(uint triangle, elvis_vec3 origin) {
    const elvis_vec4 row0 = elvis_fetch4_core_triangles(triangle, 0u), row1 = elvis_fetch4_core_triangles(triangle, 1u);
    const elvis_vec4 row2 = elvis_fetch4_core_triangles(triangle, 2u);
    precise const elvis_vec3 a = row0.xyz - origin;
    precise const elvis_vec3 b = elvis_vec3(row0.w, row1.xy) - origin;
    precise const elvis_vec3 c = elvis_vec3(row1.zw, row2.x) - origin;
    return core_triangle(a, b, c);
}

void core_consider_triangle(uint triangle, bool is_active, core_surface_ray ray, elvis_vec3 origin, core_shear shear,
                            inout core_votes votes, inout core_hit best) {
    const core_triangle corners = core_triangle_from(triangle, origin);
    const elvis_vec3 a = core_sheared(shear, corners.a), b = core_sheared(shear, corners.b), c = core_sheared(shear, corners.c);
    const elvis_real u = core_edge_function(c.x, b.y, c.y, b.x);
    const elvis_real v = core_edge_function(a.x, c.y, a.y, c.x);
    const elvis_real w = core_edge_function(b.x, a.y, b.y, a.x);
    const elvis_real area = u + v + w;
    const bool is_within = min(min(u, v), w) >= elvis_real(0) || max(max(u, v), w) <= elvis_real(0);
    const bool is_regular = area != elvis_real(0);
    const elvis_real inverse = is_regular ? elvis_real(1) / area : elvis_real(0);
    const elvis_real t = (u * a.z + v * b.z + w * c.z) * inverse * shear.scale;

    // Across the ray a corner is off by this much; an edge function by that times the edge's length.
    const elvis_real far = max(max(core_norm1(corners.a), core_norm1(corners.b)), core_norm1(corners.c));
    const elvis_real off = elvis_real(2) * ray.noise + elvis_real(8) * CORE_ROUNDOFF * far;
    const elvis_real tolerance_u = off * (abs(c.x - b.x) + abs(c.y - b.y)), tolerance_v = off * (abs(a.x - c.x) + abs(a.y - c.y));
    const elvis_real tolerance_w = off * (abs(b.x - a.x) + abs(b.y - a.y));
    const elvis_real side = area < elvis_real(0) ? elvis_real(-1) : elvis_real(1);
    const bool is_near = side * u >= -tolerance_u && side * v >= -tolerance_v && side * w >= -tolerance_w;
    const bool is_clear = side * u >= tolerance_u && side * v >= tolerance_v && side * w >= tolerance_w;
    const elvis_vec3 normal = cross(corners.b - corners.a, corners.c - corners.a);
    const elvis_real across = abs(dot(normal, ray.direction));
    const elvis_real error = off * core_norm1(normal) / max(across, elvis_real(1e-30LF) * core_norm1(normal));
    const bool counts = is_active && is_regular && is_near && core_is_counted(ray, t, error, best);
    const bool is_better = core_vote(votes, best, t, error, is_within, is_clear, area < elvis_real(0), counts);
    core_take_hit(is_better, t, error, normal, elvis_real(0), best);
}

// Where the ray's pixel ends at the parameter t, in each sheared coordinate, and in the world.
struct core_pixel_size {
    elvis_real across, down, world;
};

core_pixel_size core_pixel_size_at(core_shear shear, elvis_real t) {
    const elvis_vec3 next = core_base_column.xyz + t * core_direction_column.xyz;
    const elvis_vec3 below = core_base_row.xyz + t * core_direction_row.xyz;
    const elvis_vec3 right = abs(core_sheared(shear, next)), under = abs(core_sheared(shear, below));
    const elvis_real half_one = elvis_real(0.5LF);
    return core_pixel_size(half_one * (right.x + under.x), half_one * (right.y + under.y), half_one * (length(next) + length(below)));
}

// Whether the triangle reaches into the pixel in front of what the ray meets, or not far behind, and is another sheet.
bool core_is_other_sheet(uint triangle, core_surface_ray ray, elvis_vec3 origin, core_shear shear, core_hit hit) {
    const core_triangle corners = core_triangle_from(triangle, origin);
    const elvis_vec3 a = core_sheared(shear, corners.a), b = core_sheared(shear, corners.b), c = core_sheared(shear, corners.c);
    const elvis_vec3 hit_normal = elvis_vec3(hit.normal_x, hit.normal_y, hit.normal_z);
    const elvis_vec3 normal = cross(corners.b - corners.a, corners.c - corners.a);
    const elvis_vec3 t = shear.scale * elvis_vec3(a.z, b.z, c.z);
    const elvis_real stretch = length(ray.direction), hit_size = length(hit_normal), size = length(normal);
    const elvis_real cosine = max(abs(dot(hit_normal, ray.direction)) / (hit_size * stretch), elvis_real(1e-3LF));
    // What the pixel shows of the sheet that the ray meets lies before this.
    const elvis_real last = hit.t + elvis_real(2) * core_pixel_size_at(shear, hit.t).world / (cosine * stretch);
    const core_pixel_size pixel = core_pixel_size_at(shear, min(max(max(t.x, t.y), t.z), last));

    const elvis_vec3 low = min(min(a, b), c), high = max(max(a, b), c), ab = abs(b - a), bc = abs(c - b), ca = abs(a - c);
    const elvis_real u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
    const elvis_real side = u + v + w < elvis_real(0) ? elvis_real(-1) : elvis_real(1);
    const bool is_reached = low.x <= pixel.across && high.x >= -pixel.across && low.y <= pixel.down && high.y >= -pixel.down &&
                            side * u >= -(pixel.across * bc.y + pixel.down * bc.x) &&
                            side * v >= -(pixel.across * ca.y + pixel.down * ca.x) &&
                            side * w >= -(pixel.across * ab.y + pixel.down * ab.x);
    const bool is_alike = abs(dot(normal, hit_normal)) >= CORE_SAME_SHEET * size * hit_size &&
                          abs(dot(normal, hit.t * ray.direction - corners.a)) <= CORE_SHEET_ROOM * pixel.world * size;
    return is_reached && min(min(t.x, t.y), t.z) <= last && !is_alike;
}

// Whether the pixel may show another sheet than that which its ray meets, which the pixels around it need not show: a narrow fold.
bool core_may_show_more(core_surface_ray ray, elvis_vec3 origin, core_shear shear, core_box_ray box_ray, core_hit hit) {
    const float room = float(core_pixel_size_at(shear, hit.t).world);
    box_ray.tolerance += 2.0 * room;
    core_stack[0] = 0u;
    uint stack_size = hit.is_hit ? 1u : 0u, work = 0u;
    bool shows_more = false;
    while (stack_size > 0u && !shows_more && work < CORE_WORK_LIMIT) {
        work += 1u;
        const uint triangle = core_next_item(box_ray, 3e38, stack_size);
        shows_more = triangle != CORE_NO_NODE && core_is_other_sheet(triangle, ray, origin, shear, hit);
        if (stack_size == 0u || shows_more) {
            break;
        }
    }
    return shows_more || stack_size > 0u;
}

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const elvis_vec3 origin = ray.origin + CORE_SHAPE(0).xyz;
    const core_shear shear = core_shear_of(ray.direction);
    const core_box_ray box_ray = core_make_box_ray(ray, origin, CORE_SHAPE(0).xyz);
    core_stack[0] = 0u;
    uint stack_size = ray.from < ray.to ? 1u : 0u;
    uint triangle = CORE_NO_NODE, work = 0u;
    core_votes votes = core_no_votes();
    while (stack_size > 0u && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (triangle == CORE_NO_NODE && stack_size > 0u) {
            triangle = core_next_item(box_ray, float(best.t + best.error), stack_size);
            if (triangle != CORE_NO_NODE || stack_size == 0u) {
                break;
            }
        }
        const bool is_active = triangle != CORE_NO_NODE;
        core_consider_triangle(is_active ? triangle : 0u, is_active, ray, origin, shear, votes, best);
        triangle = CORE_NO_NODE;
        if (stack_size == 0u) {
            break;
        }
    }
    best.is_undecided = best.is_undecided || core_is_undecided(votes, best);
    best.is_cut_short = stack_size > 0u;
    if (ray.with_whole_pixel && core_may_show_more(ray, origin, shear, box_ray, best)) {
        best.bending = CORE_FAR;
    }
    return best;
}
