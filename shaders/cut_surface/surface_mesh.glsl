// Meshes of triangles: descent through a hierarchy, nearest boxes first, and the watertight test of S. Woop, C. Benthin, I. Wald,
// "Watertight ray/triangle intersection" (2013): corners are sheared so that the ray becomes an axis, each corner in the same way
// whatever triangle it belongs to; the signs of the three edge functions are exact for these numbers, and a ray through an edge
// belongs to both sides. So no ray passes between triangles that share their corners.
//
// Rows: xyz: reference point minus the origin of corners and hierarchy.
//
// Buffers: core_triangles, nine numbers each; core_nodes.

#include "cut_surface/surface_descent.glsl"

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

elvis_real core_component(elvis_vec3 v, uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const elvis_vec3 origin = ray.origin + CORE_SHAPE(0).xyz;
    const elvis_vec3 steep = abs(ray.direction);
    const uint kz = steep.x >= steep.y && steep.x >= steep.z ? 0u : steep.y >= steep.z ? 1u : 2u;
    const uint kx = (kz + 1u) % 3u, ky = (kz + 2u) % 3u;
    const elvis_real scale = elvis_real(1) / core_component(ray.direction, kz);
    const elvis_real shear_x = core_component(ray.direction, kx) * scale, shear_y = core_component(ray.direction, ky) * scale;

    const core_box_ray box_ray = core_make_box_ray(ray, origin, CORE_SHAPE(0).xyz);
    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    uint stack_size = ray.from < ray.to ? 1u : 0u;
    uint item = CORE_NO_NODE;
    uint work = 0u;
    core_votes votes = core_no_votes();
    while ((item != CORE_NO_NODE || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (item == CORE_NO_NODE && stack_size > 0u) {
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            const float farthest = float(best.t + best.error);
            const bool is_met = core_box_entry(node, box_ray, farthest) < 3e38;
            item = is_met && node.is_leaf ? node.child : CORE_NO_NODE;
            if (is_met && !node.is_leaf) {
                const float first = core_box_entry(core_fetch_node(node.child), box_ray, farthest);
                const float second = core_box_entry(core_fetch_node(node.child + 1u), box_ray, farthest);
                stack[stack_size] = node.child + (second < first ? 0u : 1u);
                stack[stack_size + 1u] = node.child + (second < first ? 1u : 0u);
                stack_size += 2u;
            }
            if (item != CORE_NO_NODE || stack_size == 0u) {
                break;
            }
        }
        const bool is_active = item != CORE_NO_NODE;
        const uint safe = is_active ? item : 0u;
        const elvis_vec4 row0 = elvis_fetch4_core_triangles(safe, 0u), row1 = elvis_fetch4_core_triangles(safe, 1u);
        const elvis_vec4 row2 = elvis_fetch4_core_triangles(safe, 2u);
        precise const elvis_vec3 a = row0.xyz - origin;
        precise const elvis_vec3 b = elvis_vec3(row0.w, row1.xy) - origin;
        precise const elvis_vec3 c = elvis_vec3(row1.zw, row2.x) - origin;
        const elvis_real az = core_component(a, kz), bz = core_component(b, kz), cz = core_component(c, kz);
        precise const elvis_real ax = core_component(a, kx) - shear_x * az;
        precise const elvis_real ay = core_component(a, ky) - shear_y * az;
        precise const elvis_real bx = core_component(b, kx) - shear_x * bz;
        precise const elvis_real by = core_component(b, ky) - shear_y * bz;
        precise const elvis_real cx = core_component(c, kx) - shear_x * cz;
        precise const elvis_real cy = core_component(c, ky) - shear_y * cz;
        const elvis_real u = core_edge_function(cx, by, cy, bx);
        const elvis_real v = core_edge_function(ax, cy, ay, cx);
        const elvis_real w = core_edge_function(bx, ay, by, ax);
        const elvis_real area = u + v + w;
        const bool is_within = min(min(u, v), w) >= elvis_real(0) || max(max(u, v), w) <= elvis_real(0);
        const bool is_regular = area != elvis_real(0);
        const elvis_real inverse = is_regular ? elvis_real(1) / area : elvis_real(0);
        const elvis_real t = (u * az + v * bz + w * cz) * inverse * scale;

        // Across the ray a corner is off by this much; an edge function by that times the edge's length.
        const elvis_real far = max(max(core_norm1(a), core_norm1(b)), core_norm1(c));
        const elvis_real off = elvis_real(2) * ray.noise + elvis_real(8) * CORE_ROUNDOFF * far;
        const elvis_real tolerance_u = off * (abs(cx - bx) + abs(cy - by)), tolerance_v = off * (abs(ax - cx) + abs(ay - cy));
        const elvis_real tolerance_w = off * (abs(bx - ax) + abs(by - ay));
        const elvis_real side = area < elvis_real(0) ? elvis_real(-1) : elvis_real(1);
        const bool is_near = side * u >= -tolerance_u && side * v >= -tolerance_v && side * w >= -tolerance_w;
        const bool is_clear = side * u >= tolerance_u && side * v >= tolerance_v && side * w >= tolerance_w;
        const elvis_vec3 normal = cross(b - a, c - a);
        const elvis_real across = abs(dot(normal, ray.direction));
        const elvis_real error = off * core_norm1(normal) / max(across, elvis_real(1e-30LF) * core_norm1(normal));
        const bool counts = is_active && is_regular && is_near && t > ray.from && t < ray.to && t - elvis_real(2) * error > ray.after;
        const bool is_better = core_vote(votes, best, t, error, is_within, is_clear, area < elvis_real(0), counts);
        best.t = is_better ? t : best.t;
        best.error = is_better ? error : best.error;
        best.normal_x = is_better ? normal.x : best.normal_x;
        best.normal_y = is_better ? normal.y : best.normal_y;
        best.normal_z = is_better ? normal.z : best.normal_z;
        best.is_hit = best.is_hit || is_better;
        item = CORE_NO_NODE;
        if (item == CORE_NO_NODE && stack_size == 0u) {
            break;
        }
    }
    best.is_undecided = core_is_undecided(votes, best);
    best.is_cut_short = item != CORE_NO_NODE || stack_size > 0u;
    return best;
}
