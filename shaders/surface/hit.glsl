// What a solver for one kind of surface is asked, and what it answers.
//
// surface/KIND.glsl defines
//
//     core_hit core_next_hit(core_surface_ray ray)
//
// the crossing with the least t in (ray.from, ray.to) that counts (core_is_counted). A ray that is not wanted has from > to, and must cost
// little.

#ifndef CORE_SURFACE_HIT
#define CORE_SURFACE_HIT

#include "arithmetic/precision.glsl"
#include "picture/samples.glsl"

struct core_surface_ray {
    // The ray is origin + t direction, relative to the picture's reference point; direction is of length 1 to about 2.
    elvis_vec3 origin, direction;
    // Crossings count behind `after`, by more than their error if a crossing lies there, too.
    elvis_real from, to, after;
    bool is_behind_crossing;
    // What else the pixel may show matters: where it may be another sheet of the surface, the hit has no bound of its bending.
    bool with_whole_pixel;
    // Rounding error of the ray's points between from and to, in each coordinate.
    elvis_real noise;
    // Where the surface is seen up to `from` and `to` only: what rounding may make of these. Else far below zero.
    elvis_real end_error;
};

struct core_hit {
    bool is_hit;
    elvis_real t;
    // Bound of t's rounding error.
    elvis_real error;
    // Of any length and on any side. Kept in scalars because of a driver that miscompiles vectors carried round a loop.
    elvis_real normal_x, normal_y, normal_z;
    // Upper bound of the surface's normal curvatures there, without sign; CORE_FAR where there is none.
    elvis_real bending;
    // Rounding decides whether the ray meets the surface, there or before.
    bool is_undecided;
    // The search was ended before it was done.
    bool is_cut_short;
    // A crossing may have been missed, because what the search rests on is not proven.
    bool is_estimated;
};

core_hit core_no_hit() {
    const elvis_real zero = elvis_real(0);
    return core_hit(false, CORE_FAR, zero, zero, zero, zero, zero, false, false, false);
}

// Numbers of the surface for this picture, prepared by the host in extended precision. First the box that the surface is drawn in
// (lower, upper; relative to the reference point), then the rows that the solver describes. The box's last number is 1 if it ends what is
// seen of the surface, else 0.
layout(std140, set = 0, binding = 1) uniform core_shape_block { elvis_vec4 core_shape[CORE_SHAPE_ROWS]; };
#define CORE_SHAPE(i) core_shape[2 + (i)]

// From where on crossings are looked for.
elvis_real core_first_t(core_surface_ray ray) {
    return ray.is_behind_crossing ? max(ray.from, min(ray.after, ray.to)) : ray.from;
}

// Whether rounding decides on which side of the surface's end a crossing lies.
bool core_is_at_end(core_surface_ray ray, elvis_real t, elvis_real error) {
    return min(abs(t - ray.from), abs(t - ray.to)) <= elvis_real(2) * error + ray.end_error;
}

// Whether a crossing counts. Where rounding decides that it is as far from the eye as those that count, the hit is undecided.
bool core_is_counted(core_surface_ray ray, elvis_real t, elvis_real error, inout core_hit best) {
    const bool is_at_start = !ray.is_behind_crossing && abs(t - ray.after) <= elvis_real(2) * error;
    best.is_undecided = best.is_undecided || is_at_start || core_is_at_end(ray, t, error);
    return t > ray.from && t < ray.to && t - (ray.is_behind_crossing ? elvis_real(2) * error : elvis_real(0)) > ray.after;
}

// Whether it goes before what was found, too.
bool core_is_next(core_surface_ray ray, elvis_real t, elvis_real error, inout core_hit best) {
    return core_is_counted(ray, t, error, best) && t < best.t;
}

void core_take_hit(bool is_better, elvis_real t, elvis_real error, elvis_vec3 normal, elvis_real bending, inout core_hit best) {
    best.t = is_better ? t : best.t;
    best.error = is_better ? error : best.error;
    best.normal_x = is_better ? normal.x : best.normal_x;
    best.normal_y = is_better ? normal.y : best.normal_y;
    best.normal_z = is_better ? normal.z : best.normal_z;
    best.bending = is_better ? bending : best.bending;
    best.is_hit = best.is_hit || is_better;
}

#endif
