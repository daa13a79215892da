// Round tubes about pieces of curves, each with a ball at its ends: descent through a hierarchy, nearest boxes first, and the crossings of
// pipe and balls in closed form, counted from where the ray comes nearest to the piece, which keeps the digits of thin tubes.
//
// Rows: xyz: reference point minus the origin of pieces and hierarchy, w: radius.
//
// Buffers: core_tubes, twelve numbers each: ends of the piece before, of the piece, of the piece after, in order along the curve;
// core_nodes.

#include "surface/descent.glsl"

// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 3000u

#define CORE_TUBE_RADIUS CORE_SHAPE(0).w

// Points are relative to where the ray comes nearest to the piece's middle: there it is at s direction, t = t0 + s.
struct core_tube {
    elvis_vec3 before, from, to, after;
    elvis_vec3 axis;
    elvis_real size;
    elvis_vec3 direction;
    elvis_real t0;
    // Of distances.
    elvis_real error;
};

core_tube core_fetch_tube(uint index, core_surface_ray ray, elvis_vec3 origin) {
    const elvis_vec4 row0 = elvis_fetch4_core_tubes(index, 0u), row1 = elvis_fetch4_core_tubes(index, 1u);
    const elvis_vec4 row2 = elvis_fetch4_core_tubes(index, 2u);
    const elvis_vec3 from = elvis_vec3(row0.w, row1.xy), to = elvis_vec3(row1.zw, row2.x);
    core_tube tube;
    tube.direction = ray.direction;
    const elvis_vec3 away = origin - elvis_real(0.5LF) * (from + to);
    tube.t0 = -dot(away, ray.direction) / dot(ray.direction, ray.direction);
    const elvis_vec3 here = origin + tube.t0 * ray.direction;
    tube.before = row0.xyz - here;
    tube.from = from - here;
    tube.to = to - here;
    tube.after = row2.yzw - here;
    const elvis_vec3 along = to - from;
    tube.size = length(along);
    tube.axis = tube.size > elvis_real(0) ? along / tube.size : elvis_vec3(0);
    tube.error = elvis_real(4) * ray.noise + elvis_real(16) * CORE_ROUNDOFF * (core_norm1(away) + core_norm1(from) + core_norm1(to));
    return tube;
}

elvis_real core_distance_from_piece(elvis_vec3 point, elvis_vec3 from, elvis_vec3 to) {
    const elvis_vec3 along = to - from;
    const elvis_real square = dot(along, along);
    const elvis_real share = square > elvis_real(0) ? clamp(dot(point - from, along) / square, elvis_real(0), elvis_real(1)) : elvis_real(0);
    return length(point - from - share * along);
}

// Whether the point lies inside the tube of the piece before or after: it is not on the surface of the whole.
bool core_is_in_neighbour(core_tube tube, elvis_vec3 point) {
    const elvis_real inside = CORE_TUBE_RADIUS - elvis_real(2) * tube.error;
    const bool has_before = tube.before != tube.from, has_after = tube.after != tube.to;
    return (has_before && core_distance_from_piece(point, tube.before, tube.from) < inside) ||
           (has_after && core_distance_from_piece(point, tube.to, tube.after) < inside);
}

// Part 0: the pipe, between the ends; 1: the ball about `from`, before it; 2: the ball about `to`, behind it.
bool core_is_on_part(core_tube tube, uint part, elvis_vec3 point) {
    const elvis_real along = dot(point - tube.from, tube.axis);
    return part == 0u ? along >= elvis_real(0) && along <= tube.size : part == 1u ? along < elvis_real(0) : along > tube.size;
}

void core_consider_crossing(core_tube tube, uint part, elvis_real s, bool may_cross, core_surface_ray ray, inout core_hit best) {
    const elvis_vec3 point = s * tube.direction;
    const elvis_real along = clamp(dot(point - tube.from, tube.axis), elvis_real(0), tube.size);
    const elvis_vec3 normal = point - tube.from - along * tube.axis;
    const elvis_real speed = length(tube.direction);
    const elvis_real slope = abs(dot(normal, tube.direction)) / CORE_TUBE_RADIUS;
    // Where the ray touches the tube, the distance is quadratic along it.
    const elvis_real error = min(tube.error / max(slope, elvis_real(1e-30LF)),
                                 elvis_real(2) * sqrt(elvis_real(2) * CORE_TUBE_RADIUS * tube.error) / speed);
    const bool counts = may_cross && core_is_on_part(tube, part, point) && !core_is_in_neighbour(tube, point);
    const bool is_better = counts && core_is_next(ray, tube.t0 + s, error, best);
    core_take_hit(is_better, tube.t0 + s, error, normal, elvis_real(1) / CORE_TUBE_RADIUS, best);
}

void core_consider_tube(core_tube tube, bool is_active, core_surface_ray ray, inout core_hit best) {
    uint part = 0u;
    while (part < 3u) {
        const elvis_vec3 center = part == 2u ? tube.to : tube.from;
        const elvis_vec3 axis = part == 0u ? tube.axis : elvis_vec3(0);
        const elvis_vec3 start = -center + dot(center, axis) * axis;
        const elvis_vec3 across = tube.direction - dot(tube.direction, axis) * axis;
        const elvis_real square = dot(across, across);
        const bool is_crossing = is_active && square > elvis_real(1e-10LF) * dot(tube.direction, tube.direction);
        const elvis_real middle = is_crossing ? -dot(start, across) / square : elvis_real(0);
        const elvis_real nearest = length(start + middle * across);
        const elvis_real room = (CORE_TUBE_RADIUS - nearest) * (CORE_TUBE_RADIUS + nearest);
        const elvis_real reach = is_crossing ? sqrt(max(room, elvis_real(0)) / square) : elvis_real(0);
        const bool may_cross = is_crossing && room >= elvis_real(0);
        core_consider_crossing(tube, part, middle - reach, may_cross, ray, best);
        core_consider_crossing(tube, part, middle + reach, may_cross, ray, best);
        // The ray passes so close to the outline that rounding decides.
        const elvis_vec3 touched = middle * tube.direction;
        const elvis_real t = tube.t0 + middle;
        const bool touches = is_crossing && abs(CORE_TUBE_RADIUS - nearest) <= tube.error && core_is_on_part(tube, part, touched) &&
                             !core_is_in_neighbour(tube, touched);
        best.is_undecided = best.is_undecided || (touches && t > ray.from && t < ray.to && t > ray.after && t <= best.t + best.error);
        part += 1u;
    }
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
        const uint item = core_next_item(box_ray, float(best.t + best.error), stack_size);
        const bool is_active = item != CORE_NO_NODE;
        core_consider_tube(core_fetch_tube(is_active ? item : 0u, ray, origin), is_active, ray, best);
    }
    best.is_cut_short = stack_size > 0u;
    return best;
}
