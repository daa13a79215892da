// Where along rays an isovalue can be met in an octant, as far as its linear models tell (isosurface/octant.glsl). Nothing is evaluated
// for it.

#include "isosurface/octant.glsl"
#include "isosurface/value_interval.glsl"

// What of `span` lies in the octant. `start` + t `motion`: the ray in the octant's coordinates.
vec2 core_octant_inside(const core_octant octant, vec3 start, vec3 motion, float tolerance, vec2 span) {
    const vec3 inverse = 1.0 / mix(motion, vec3(1e-30), lessThan(abs(motion), vec3(1e-30)));
    const vec3 a = (-1.0 - tolerance - start) * inverse, b = (1.0 + tolerance - start) * inverse;
    const vec3 low = min(a, b), high = max(a, b);
    span.x = max(span.x, max(max(low.x, low.y), low.z));
    span.y = min(span.y, min(min(high.x, high.y), high.z));
#if ELVIS_SHAPE != ELVIS_SHAPE_HEXAHEDRON
    // Only what lies in the shape counts.
    const float beyond = octant.size * (1.0 + tolerance) - core_octant_half_side(octant.code);
    const vec3 xi = core_octant_middle(octant.code) + octant.size * start, change = octant.size * motion;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const vec4 constraint = vec4(core_face_constraint(face));
        const float excess = dot(constraint.xyz, xi) + constraint.w - float(CORE_CONSTRAINT_NORM) * beyond;
        const float slope = dot(constraint.xyz, change);
        const float root = -excess / slope;
        span.y = slope > 0.0 && octant.size > 0.0 ? min(span.y, root) : span.y;
        span.x = slope < 0.0 && octant.size > 0.0 ? max(span.x, root) : span.x;
    }
#endif
    return span;
}

// What of that leaves room for an isovalue.
vec2 core_octant_value_span(const core_octant octant, vec3 start, vec3 motion, float tolerance, vec2 span) {
    return core_value_interval(octant.value + dot(octant.slope, start), dot(octant.slope, motion), core_octant_error(octant, tolerance),
                               span);
}

struct core_octant_span {
    // The ray goes through the octant before the end; it can meet an isovalue there.
    bool is_inside, is_met;
    vec2 span;
    // The span's middle.
    vec3 xi;
};

core_octant_span core_octant_span_of(const core_octant octant, const core_ray ray, float end_t) {
    const vec3 start = core_octant_rotate(octant, ray.box_origin - octant.middle);
    const vec3 motion = core_octant_rotate(octant, vec3(ray.direction));
    const float tolerance = core_octant_tolerance(octant, ray.far);
    const vec2 inside = core_octant_inside(octant, start, motion, tolerance, vec2(float(ray.least_t), end_t));
    core_octant_span reached;
    reached.span = core_octant_value_span(octant, start, motion, tolerance, inside);
    reached.is_inside = inside.x <= inside.y;
    reached.is_met = reached.is_inside && reached.span.x <= reached.span.y;
    reached.xi = core_octant_middle(octant.code) + octant.size * (start + 0.5 * (reached.span.x + reached.span.y) * motion);
    return reached;
}
