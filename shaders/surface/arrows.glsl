// Arrows: descent through a hierarchy, nearest boxes first, and the crossings of shaft, head and their ends in closed form, counted from
// where the ray comes nearest to the arrow's middle, which keeps the digits of small arrows.
//
// Rows: 0: xyz: reference point minus the origin of arrows and hierarchy; 1: radius of the shaft, radius and length of the head, as shares
// of an arrow's length.
//
// Buffers: core_arrows, eight numbers each: ends, value; core_arrow_numbers: elements; core_nodes.

#define CORE_HAS_OWN_VALUES 1

#include "surface/descent.glsl"

// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 3000u

// Points are relative to where the ray comes nearest to the arrow's middle: there it is at s direction, t = t0 + s.
struct core_arrow {
    elvis_vec3 from, axis;
    // Lengths in the world.
    elvis_real size, neck, shaft_radius, head_radius;
    elvis_vec3 direction;
    elvis_real t0;
    // Of distances.
    elvis_real error;
};

// The arrow of the crossing that core_next_hit has found.
uint core_hit_arrow = 0u;

elvis_real core_hit_value() { return elvis_fetch_core_arrows(core_hit_arrow, 6u); }
uint core_hit_number() { return elvis_fetch_core_arrow_numbers(core_hit_arrow, 0u); }

core_arrow core_fetch_arrow(uint index, core_surface_ray ray, elvis_vec3 origin) {
    const elvis_vec4 row0 = elvis_fetch4_core_arrows(index, 0u), row1 = elvis_fetch4_core_arrows(index, 1u);
    const elvis_vec3 from = row0.xyz, to = elvis_vec3(row0.w, row1.xy), shares = CORE_SHAPE(1).xyz;
    core_arrow arrow;
    arrow.direction = ray.direction;
    const elvis_vec3 away = origin - elvis_real(0.5LF) * (from + to);
    arrow.t0 = -dot(away, ray.direction) / dot(ray.direction, ray.direction);
    arrow.from = from - (origin + arrow.t0 * ray.direction);
    const elvis_vec3 along = to - from;
    arrow.size = length(along);
    arrow.axis = arrow.size > elvis_real(0) ? along / arrow.size : elvis_vec3(0);
    arrow.shaft_radius = shares.x * arrow.size;
    arrow.head_radius = shares.y * arrow.size;
    arrow.neck = (elvis_real(1) - shares.z) * arrow.size;
    arrow.error = elvis_real(4) * ray.noise + elvis_real(16) * CORE_ROUNDOFF * (core_norm1(away) + core_norm1(from) + core_norm1(to));
    return arrow;
}

// Parts of an arrow: its end, the ring between shaft and head, the shaft, the head.
#define CORE_ARROW_END 0u
#define CORE_ARROW_RING 1u
#define CORE_ARROW_SHAFT 2u
#define CORE_ARROW_HEAD 3u

// How far a point of the surface that a part lies in is inside of the part; negative outside.
elvis_real core_depth_in_part(core_arrow arrow, uint part, elvis_real along, elvis_real radius) {
    const elvis_real in_shaft = min(along, arrow.neck - along), in_head = min(along - arrow.neck, arrow.size - along);
    const elvis_real in_ring = min(radius - arrow.shaft_radius, arrow.head_radius - radius);
    return part == CORE_ARROW_END    ? arrow.shaft_radius - radius
           : part == CORE_ARROW_RING ? in_ring
           : part == CORE_ARROW_SHAFT ? in_shaft
                                      : in_head;
}

struct core_arrow_point {
    elvis_real along, radius;
    // Out of the axis, of the length `radius`.
    elvis_vec3 across;
};

core_arrow_point core_arrow_point_at(core_arrow arrow, elvis_real s) {
    const elvis_vec3 point = s * arrow.direction - arrow.from;
    core_arrow_point at;
    at.along = dot(point, arrow.axis);
    at.across = point - at.along * arrow.axis;
    at.radius = length(at.across);
    return at;
}

// Across the surface that the part lies in.
elvis_vec3 core_arrow_normal(core_arrow arrow, uint part, core_arrow_point at) {
    const elvis_vec3 outward = at.radius > elvis_real(0) ? at.across / at.radius : elvis_vec3(0);
    const elvis_real slope = arrow.head_radius / (arrow.size - arrow.neck);
    return part <= CORE_ARROW_RING ? arrow.axis : part == CORE_ARROW_SHAFT ? outward : normalize(outward + slope * arrow.axis);
}

// A crossing of the ray with the surface that the part lies in. Where rounding decides whether it is in the part, the hit is undecided.
void core_consider_crossing(core_arrow arrow, uint part, elvis_real s, bool may_cross, core_surface_ray ray, uint item, inout core_hit best) {
    const core_arrow_point at = core_arrow_point_at(arrow, s);
    const elvis_vec3 normal = core_arrow_normal(arrow, part, at);
    const elvis_real speed = length(arrow.direction), slope = abs(dot(normal, arrow.direction));
    // Where the ray touches shaft or head, the distance is quadratic along it.
    const elvis_real touching = elvis_real(2) * sqrt(elvis_real(2) * arrow.head_radius * arrow.error) / speed;
    const elvis_real steep = arrow.error / max(slope, elvis_real(1e-30LF));
    const elvis_real error = part <= CORE_ARROW_RING ? steep : min(steep, touching);
    const elvis_real inside = core_depth_in_part(arrow, part, at.along, at.radius), t = arrow.t0 + s;
    const elvis_real doubt = elvis_real(2) * (arrow.error + error * speed);
    const bool is_in_front = t > ray.from && t < ray.to && t > ray.after && t <= best.t + best.error;
    best.is_undecided = best.is_undecided || (may_cross && is_in_front && abs(inside) <= doubt);
    const bool is_better = may_cross && inside >= elvis_real(0) && core_is_next(ray, t, error, best);
    core_take_hit(is_better, t, error, normal, elvis_real(1) / arrow.shaft_radius, best);
    core_hit_arrow = is_better ? item : core_hit_arrow;
}

void core_consider_disc(core_arrow arrow, uint part, bool is_active, core_surface_ray ray, uint item, inout core_hit best) {
    const elvis_real speed = dot(arrow.axis, arrow.direction);
    const elvis_real height = dot(arrow.from, arrow.axis) + (part == CORE_ARROW_RING ? arrow.neck : elvis_real(0));
    const bool may_cross = is_active && abs(speed) > elvis_real(1e-6LF) * length(arrow.direction);
    core_consider_crossing(arrow, part, may_cross ? height / speed : elvis_real(0), may_cross, ray, item, best);
}

// Shaft and head: |q|^2 - k^2 h^2 = r^2 at a distance q from the axis and a height h above the tip. Of the shaft, k = 0 and r is its radius; of
// the head, r = 0 and k is its slope. a s^2 + 2 b s + c = 0 along the ray.
void core_consider_round(core_arrow arrow, uint part, bool is_active, core_surface_ray ray, uint item, inout core_hit best) {
    const bool is_head = part == CORE_ARROW_HEAD;
    const elvis_real slope = is_head ? arrow.head_radius / (arrow.size - arrow.neck) : elvis_real(0);
    const elvis_real radius = is_head ? elvis_real(0) : arrow.shaft_radius;
    const elvis_real base = dot(arrow.from, arrow.axis), rise = dot(arrow.direction, arrow.axis);
    const elvis_real height = -base - arrow.size;
    const elvis_vec3 start = base * arrow.axis - arrow.from, across = arrow.direction - rise * arrow.axis;
    const elvis_real square = dot(arrow.direction, arrow.direction), steep = slope * slope;
    const elvis_real a = dot(across, across) - steep * rise * rise;
    const elvis_real b = dot(start, across) - steep * height * rise;
    const elvis_real c = dot(start, start) - steep * height * height - radius * radius;
    const elvis_real room = b * b - a * c;
    // What an error of the points makes of it.
    const elvis_real reach = length(start) + slope * abs(height) + radius;
    const elvis_real noise = elvis_real(8) * square * reach * (arrow.error + elvis_real(4) * CORE_ROUNDOFF * reach);
    const bool may_cross = is_active && room >= elvis_real(0);
    const elvis_real root = sqrt(max(room, elvis_real(0))), far = -(b + (b < elvis_real(0) ? -root : root));
    const bool has_first = abs(a) > elvis_real(1e-10LF) * square, has_second = abs(far) > elvis_real(0);
    core_consider_crossing(arrow, part, has_first ? far / a : elvis_real(0), may_cross && has_first, ray, item, best);
    core_consider_crossing(arrow, part, has_second ? c / far : elvis_real(0), may_cross && has_second, ray, item, best);
    // The ray passes so close to the outline that rounding decides.
    const elvis_real middle = has_first ? -b / a : elvis_real(0), t = arrow.t0 + middle;
    const core_arrow_point at = core_arrow_point_at(arrow, middle);
    const bool touches = is_active && has_first && abs(room) <= noise && core_depth_in_part(arrow, part, at.along, at.radius) >= elvis_real(0);
    best.is_undecided = best.is_undecided || (touches && t > ray.from && t < ray.to && t > ray.after && t <= best.t + best.error);
}

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const elvis_vec3 origin = ray.origin + CORE_SHAPE(0).xyz;
    const core_box_ray box_ray = core_make_box_ray(ray, origin, CORE_SHAPE(0).xyz);
    core_stack[0] = 0u;
    uint stack_size = ray.from < ray.to ? 1u : 0u;
    uint work = 0u;
    while (stack_size > 0u && work < CORE_WORK_LIMIT) {
        work += 1u;
        const uint found = core_next_item(box_ray, float(best.t + best.error), stack_size);
        const bool is_active = found != CORE_NO_NODE;
        const uint item = is_active ? found : 0u;
        const core_arrow arrow = core_fetch_arrow(item, ray, origin);
        core_consider_disc(arrow, CORE_ARROW_END, is_active, ray, item, best);
        core_consider_disc(arrow, CORE_ARROW_RING, is_active, ray, item, best);
        core_consider_round(arrow, CORE_ARROW_SHAFT, is_active, ray, item, best);
        core_consider_round(arrow, CORE_ARROW_HEAD, is_active, ray, item, best);
    }
    best.is_cut_short = stack_size > 0u;
    return best;
}
