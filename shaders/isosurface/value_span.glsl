// Where along rays an isovalue can be met in an element, as far as its linear models tell: of the mapping (element/linearization.glsl)
// and of the field (field/linear_model.glsl). Nothing is evaluated for it.
//
// `start` + t `direction`: the ray in reference coordinates, as linearized.

#include "isosurface/value_interval.glsl"

// Of the linearization at the centroid, which keeps this many digits of coordinates in the element.
#define CORE_LINEAR_ERROR 2e-2

// How far a point of the element is from where it is predicted.
float core_linear_error(float curvature) { return curvature * float(CORE_EXTENT * CORE_EXTENT) + CORE_LINEAR_ERROR; }

// Of the field's model at such a point.
float core_model_error(core_linear_model model, float beyond) {
    const vec3 size = abs(model.slope);
    return model.remainder + beyond * (size.x + size.y + size.z);
}

// What of the ray, within `span`, can lie in the element as far as the mapping's linearization at the centroid tells.
vec2 core_linear_span(vec3 start, vec3 direction, float curvature, vec2 span) {
    const float slack = float(CORE_CONSTRAINT_NORM) * core_linear_error(curvature);
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const vec4 constraint = vec4(core_face_constraint(face));
        const float excess = dot(constraint.xyz, start) + constraint.w - slack, slope = dot(constraint.xyz, direction);
        const float root = -excess / slope;
        span.y = slope > 0.0 ? min(span.y, root) : span.y;
        span.x = slope < 0.0 ? max(span.x, root) : span.x;
    }
    return span;
}

// What of that leaves room for an isovalue by the linear model of the whole element, if there is only one; all of it if there are
// several.
vec2 core_value_span(core_linear_model model, vec3 start, vec3 direction, float curvature, vec2 span) {
    const float value = model.value + dot(model.slope, start - vec3(CORE_CENTROID)), slope = dot(model.slope, direction);
    return core_value_interval(value, slope, core_model_error(model, core_linear_error(curvature)), span);
}
