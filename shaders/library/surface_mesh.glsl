// Meshes of triangles: descent through a hierarchy, nearest boxes first, and the watertight test of S. Woop, C. Benthin, I. Wald,
// "Watertight ray/triangle intersection" (2013): corners are sheared so that the ray becomes an axis, each corner in the same way
// whatever triangle it belongs to; the signs of the three edge functions are exact for these numbers, and a ray through an edge
// belongs to both sides. So no ray passes between triangles that share their corners.
//
// Rows: xyz: reference point minus the origin of corners and hierarchy.
//
// Buffers: core_triangles, nine numbers each; core_nodes.
//
// Rounding moves corners by a little, across the ray: rays that pass an edge within that are near it. A ray near the edge of a single
// triangle, or of two that fold back there, is undecided, unless another triangle decides it.

#include "library/surface_hit.glsl"
#include "library/hierarchy.glsl"

// Turns of one pixel: see library/locate.glsl.
#define CORE_WORK_LIMIT 3000u

// Where the ray enters the box, a little before; more than anything if it does not meet it between its ends.
float core_box_entry(core_node node, vec3 origin, vec3 inverse, float tolerance, float from, float to) {
    const vec3 a = (node.lower - tolerance - origin) * inverse;
    const vec3 b = (node.upper + tolerance - origin) * inverse;
    const vec3 low = min(a, b), high = max(a, b);
    const float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
    const float slack = 1e-5 * (abs(enter) + abs(leave));
    return enter <= leave + slack && leave + slack >= from && enter - slack <= to ? enter - slack : 3.3e38;
}

// The sign, exact, of a b - c d; times its rounded value.
elvis_real core_edge_function(elvis_real a, elvis_real b, elvis_real c, elvis_real d) {
    precise const elvis_real p = a * b;
    precise const elvis_real q = c * d;
    precise elvis_real result = p - q;
    // Rounding keeps order: only equal products hide a sign.
    for (uint turn = 0u; turn < (result == elvis_real(0) ? 1u : 0u); ++turn) {
        elvis_real p0, p_error, q0, q_error;
        core_two_product(a, b, p0, p_error);
        core_two_product(c, d, q0, q_error);
        result = p_error - q_error;
    }
    return result;
}

elvis_real core_component(elvis_vec3 v, uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }

core_hit core_next_hit(core_ray ray) {
    core_hit best = core_no_hit();
    const elvis_vec3 origin = ray.origin + CORE_SHAPE(0).xyz;
    const elvis_vec3 steep = abs(ray.direction);
    const uint kz = steep.x >= steep.y && steep.x >= steep.z ? 0u : steep.y >= steep.z ? 1u : 2u;
    const uint kx = (kz + 1u) % 3u, ky = (kz + 2u) % 3u;
    const elvis_real scale = elvis_real(1) / core_component(ray.direction, kz);
    const elvis_real shear_x = core_component(ray.direction, kx) * scale, shear_y = core_component(ray.direction, ky) * scale;

    const vec3 box_origin = vec3(origin);
    const vec3 box_direction = vec3(ray.direction);
    const vec3 tiny = vec3(1e-30);
    const vec3 box_inverse = 1.0 / mix(box_direction, tiny, lessThan(abs(box_direction), tiny));
    const vec3 shift = abs(vec3(CORE_SHAPE(0).xyz));
    const float box_tolerance = float(elvis_real(2) * ray.noise) + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(shift.x, shift.y), shift.z);
    const float from = float(max(ray.from, min(ray.after, ray.to))), to = float(ray.to);

    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    uint stack_size = ray.from < ray.to ? 1u : 0u;
    uint item = CORE_NO_NODE;
    uint work = 0u;
    // What is known of the nearest crossing: some triangle holds it well inside; near it, triangles facing the ray and facing away.
    bool is_sure = false;
    uint n_facing = 0u, n_averted = 0u;
    // The nearest near miss.
    elvis_real near_t = CORE_FAR, near_error = elvis_real(0);
    bool is_near_facing = false;
    while ((item != CORE_NO_NODE || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (item == CORE_NO_NODE && stack_size > 0u) {
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            const float farthest = min(to, float(best.t + best.error));
            const bool is_met = core_box_entry(node, box_origin, box_inverse, box_tolerance, from, farthest) < 3e38;
            item = is_met && node.is_leaf ? node.child : CORE_NO_NODE;
            for (uint turn = 0u; turn < (is_met && !node.is_leaf ? 1u : 0u); ++turn) {
                const float first = core_box_entry(core_fetch_node(node.child), box_origin, box_inverse, box_tolerance, from, to);
                const float second = core_box_entry(core_fetch_node(node.child + 1u), box_origin, box_inverse, box_tolerance, from, to);
                stack[stack_size] = node.child + (second < first ? 0u : 1u);
                stack[stack_size + 1u] = node.child + (second < first ? 1u : 0u);
                stack_size += 2u;
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
        const bool is_facing = area < elvis_real(0);

        const bool counts = is_active && is_regular && t > ray.from && t < ray.to && t - elvis_real(2) * error > ray.after;
        const bool is_hit = counts && is_within;
        const bool is_same = abs(t - best.t) <= elvis_real(2) * (error + best.error);
        const bool is_better = is_hit && t < best.t;
        const bool is_news = is_better && !is_same;
        // The near miss found before may be of the same crossing.
        const bool is_near_same = abs(t - near_t) <= elvis_real(2) * (error + near_error);
        n_facing = is_news ? (is_near_same && is_near_facing ? 1u : 0u) : n_facing;
        n_averted = is_news ? (is_near_same && !is_near_facing ? 1u : 0u) : n_averted;
        is_sure = is_sure && !is_news;
        const bool votes = counts && is_near && (is_news || is_same);
        n_facing += votes && is_facing ? 1u : 0u;
        n_averted += votes && !is_facing ? 1u : 0u;
        is_sure = is_sure || (is_hit && is_clear && (is_news || is_same));
        const bool is_miss = counts && is_near && !is_within && t < near_t;
        near_t = is_miss ? t : near_t;
        near_error = is_miss ? error : near_error;
        is_near_facing = is_miss ? is_facing : is_near_facing;
        best.t = is_better ? t : best.t;
        best.error = is_better ? error : best.error;
        best.normal_x = is_better ? normal.x : best.normal_x;
        best.normal_y = is_better ? normal.y : best.normal_y;
        best.normal_z = is_better ? normal.z : best.normal_z;
        best.is_hit = best.is_hit || is_better;
        item = CORE_NO_NODE;
    }
    const bool is_missed_before = near_t < best.t - elvis_real(2) * (near_error + best.error);
    best.is_undecided = is_missed_before || (best.is_hit && !is_sure && max(n_facing, n_averted) < 2u);
    best.is_cut_short = item != CORE_NO_NODE || stack_size > 0u;
    return best;
}
