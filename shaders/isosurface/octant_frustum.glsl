// Whether the rays between those at four corners of a picture can meet an isovalue in an octant, as far as its linear models tell
// (isosurface/octant.glsl). The kernel brings isosurface/isovalues.glsl.

#include "isosurface/octant.glsl"
#include "tiles/tile_frustum.glsl"

// Largest coordinate of the frustum's origins.
float core_frustum_far(core_frustum frustum, vec3 shift) {
    float far = 0.0;
    for (int corner = 0; corner < 4; ++corner) {
        const vec3 size = abs(frustum.origins[corner] + shift) + abs(shift);
        far = max(far, max(max(size.x, size.y), size.z));
    }
    return far;
}

// Between t = span.x and span.y. A ray's point is, at each t, a mean of those of the corners.
bool core_frustum_meets_isovalue(core_octant octant, core_frustum frustum, vec2 span) {
    const vec3 shift = vec3(core_reference_in_hierarchy.xyz);
    const float tolerance = core_octant_tolerance(octant, core_frustum_far(frustum, shift));
    // Where all corners move to the same side, none is inside the octant before the first enters, or after the last has left.
    vec3 first_enter = vec3(3e38), last_leave = vec3(-3e38), least_motion = vec3(3e38), most_motion = vec3(-3e38);
    for (int corner = 0; corner < 4; ++corner) {
        const vec3 start = core_octant_rotate(octant, frustum.origins[corner] + shift - octant.middle);
        const vec3 motion = core_octant_rotate(octant, frustum.directions[corner]);
        const vec3 inverse = 1.0 / mix(motion, vec3(1e-30), lessThan(abs(motion), vec3(1e-30)));
        const vec3 a = (-1.0 - tolerance - start) * inverse, b = (1.0 + tolerance - start) * inverse;
        first_enter = min(first_enter, min(a, b));
        last_leave = max(last_leave, max(a, b));
        least_motion = min(least_motion, motion);
        most_motion = max(most_motion, motion);
    }
    const bvec3 moves = notEqual(greaterThan(least_motion, vec3(1e-20)), lessThan(most_motion, vec3(-1e-20)));
    const vec3 enter = mix(vec3(span.x), first_enter, moves), leave = mix(vec3(span.y), last_leave, moves);
    span = vec2(max(span.x, max(max(enter.x, enter.y), enter.z)), min(span.y, min(min(leave.x, leave.y), leave.z)));
    float least = 3e38, most = -3e38;
    vec3 low = vec3(3e38), high = vec3(-3e38);
    for (int corner = 0; corner < 4; ++corner) {
        const vec3 start = core_octant_rotate(octant, frustum.origins[corner] + shift - octant.middle);
        const vec3 motion = core_octant_rotate(octant, frustum.directions[corner]);
        const vec3 a = start + span.x * motion, b = start + span.y * motion;
        low = min(low, min(a, b));
        high = max(high, max(a, b));
        const float value_a = dot(octant.slope, a), value_b = dot(octant.slope, b);
        least = min(least, min(value_a, value_b));
        most = max(most, max(value_a, value_b));
    }
    const vec3 beyond = max(low, -high);
    const bool is_outside = span.x > span.y || max(max(beyond.x, beyond.y), beyond.z) > 1.0 + tolerance;
    const float error = core_octant_error(octant, tolerance) + 16.0 * CORE_FLOAT_ROUNDOFF * (abs(octant.value) + abs(least) + abs(most));
    const uint first = core_isovalue_from(elvis_real(octant.value + least - error));
    const bool can_hold = !(error < CORE_VALUE_UNKNOWN) ||
                          (first < CORE_N_ISOVALUES &&
                           float(core_isovalue_at(min(first, CORE_N_ISOVALUES - 1u))) <= octant.value + most + error);
    // Of a frustum so wide that it has no direction nothing is known. What rests on estimates is left to the pixels, which flag it.
    return !any(moves) || (!is_outside && (can_hold || (octant.code & CORE_OCTANT_ESTIMATED) != 0u));
}
