// What one evaluation of mapping and field at a point xi of an element tells about an interval of a ray.
//
// The mapping is linearized at xi. The interval's point at parameter s (from the interval's middle) that lies in the element has the offset
// q + s w from xi but for `beyond`, the error of a Newton step (element/prediction.glsl) and rounding. So the faces, which are linear
// in reference coordinates, cut off the ends that surely lie outside, and the field's Taylor model over what is left
// (arithmetic/model.glsl) bounds the field along the ray by a line and an error:
//
//     f(s) = value + slope s + e,   |e| <= error,   wherever the interval lies in the element.
//
// The kernel brings isosurface/isovalues.glsl, element/element_frame.glsl and field/shown_model.glsl.

#include "element/inside.glsl"
#include "arithmetic/model.glsl"
#include "element/bend_form.glsl"
#include "element/prediction.glsl"
#include "element/shape_region.glsl"

// What bounds how far predictions from xi are off.
struct core_interval_bend {
    elvis_real curvature;
    // From xi, of the points that are looked for; 0: the near solution of a prediction is theirs.
    elvis_real farthest;
#if CORE_HAS_BEND_FORMS
    core_local_bend local;
    // The same as `farthest`, by the length N.
    elvis_real farthest_length;
#endif
};

struct core_ray_interval {
    // Offset of the middle, and its change along the ray, in reference coordinates.
    elvis_vec3 q, w;
    // What is left of the interval; low > high: nothing.
    elvis_real low, high;
    // By how much at least all of the interval violates one face, as predicted; negative if it does not.
    elvis_real clearance;
    // Largest offset from xi of what is left, in the maximum norm; what the linearization leaves out there, without rounding and with it.
    elvis_real radius, bent_off, beyond;
#if CORE_HAS_BEND_FORMS
    // Largest length N of an offset; CORE_FAR where none is known.
    elvis_real bend_length;
#endif
    // In the world.
    elvis_real way;
    elvis_real value, slope, error;
    bool is_known;
};

elvis_real core_interval_radius(core_ray_interval interval) {
    return max(core_max_norm(interval.q + interval.low * interval.w), core_max_norm(interval.q + interval.high * interval.w));
}

// What the linearization leaves out of what is left of the interval, whose ends are predicted `step` away at most, in the maximum norm.
void core_interval_leave_out(const core_interval_bend bend, elvis_real step, inout core_ray_interval interval) {
    interval.bent_off = bend.farthest > elvis_real(0) ? core_prediction_error_within(bend.curvature, step, bend.farthest)
                                                      : core_prediction_error(bend.curvature, step);
#if CORE_HAS_BEND_FORMS
    const elvis_real length_to = max(core_bend_length(bend.local, interval.q + interval.low * interval.w),
                                     core_bend_length(bend.local, interval.q + interval.high * interval.w));
    const elvis_real distance = core_prediction_distance_within(bend.local.curvature, length_to, bend.farthest_length);
    interval.bend_length = bend.local.is_known ? distance : CORE_FAR;
    interval.bent_off = bend.local.is_known ? min(interval.bent_off, core_bend_error(bend.local, distance)) : interval.bent_off;
#endif
}

// The interval from -half_width to half_width, cut by the faces. `offset`: of the middle from the image of xi.
core_ray_interval core_interval_in_element(elvis_vec3 xi, const core_frame frame, elvis_vec3 offset, elvis_vec3 direction,
                                           elvis_real half_width, const core_interval_bend bend) {
    core_ray_interval interval;
    interval.q = core_to_xi(frame, offset);
    interval.w = core_to_xi(frame, direction);
    interval.low = -half_width;
    interval.high = half_width;
    const elvis_real rounding = core_max_norm(frame.xi_error);
    interval.clearance = -CORE_UNKNOWN;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        interval.clearance = max(interval.clearance, dot(constraint.xyz, xi + interval.q) + constraint.w -
                                                   half_width * abs(dot(constraint.xyz, interval.w)));
    }
    // What is left is nearer, and so better known: a second time.
    for (int iteration = 0; iteration < 2; ++iteration) {
        const elvis_real step = core_interval_radius(interval);
        core_interval_leave_out(bend, step, interval);
        interval.beyond = interval.bent_off + rounding;
        interval.radius = step + interval.beyond;
        elvis_real low = interval.low, high = interval.high;
        for (int face = 0; face < CORE_N_FACES; ++face) {
            const elvis_vec4 constraint = core_face_constraint(face);
            const elvis_real slack = core_model_norm1(constraint.xyz) * (interval.beyond + elvis_real(8) * CORE_ROUNDOFF);
            const elvis_real excess = dot(constraint.xyz, xi + interval.q) + constraint.w - slack;
            const elvis_real slope = dot(constraint.xyz, interval.w);
            const elvis_real root = -excess / slope;
            high = slope > elvis_real(0) ? min(high, root) : high;
            low = slope < elvis_real(0) ? max(low, root) : low;
            // Along the face, and beyond it.
            high = slope == elvis_real(0) && excess > elvis_real(0) ? low - half_width : high;
        }
        interval.low = low;
        interval.high = high;
    }
    interval.way = max(length(offset + interval.low * direction), length(offset + interval.high * direction));
    return interval;
}

#if ELVIS_HAS_INSIDE
// Cuts the interval, which the faces have cut, by the element's own boundary, too.
void core_cut_interval_inside(core_inside g, inout core_ray_interval interval) {
    const elvis_real slack = core_model_norm1(g.slope) * (interval.beyond + elvis_real(8) * CORE_ROUNDOFF) + g.rounding +
                             core_inside_bend(g, interval.radius);
    const elvis_real excess = g.value + dot(g.slope, interval.q) - slack, slope = dot(g.slope, interval.w);
    const elvis_real root = -excess / slope;
    const bool is_beyond = slope == elvis_real(0) && excess > elvis_real(0);
    interval.high = is_beyond ? interval.low - elvis_real(1) : slope > elvis_real(0) ? min(interval.high, root) : interval.high;
    interval.low = slope < elvis_real(0) ? max(interval.low, root) : interval.low;
}
#endif

// What the field at the interval's points is off because the mapping bends.
elvis_real core_value_bent_off(const core_ray_interval interval, const core_interval_bend bend, const core_frame frame, elvis_vec3 slope) {
    const elvis_real off = core_model_norm1(slope) * interval.bent_off;
#if CORE_HAS_BEND_FORMS
    const elvis_real by_forms = core_bend_value_error(bend.local, core_to_world(frame, slope), interval.bend_length);
    return bend.local.is_known ? min(off, by_forms) : off;
#else
    return off;
#endif
}

// What it is off because those are, for rounding, too.
elvis_real core_value_off(const core_ray_interval interval, const core_interval_bend bend, const core_frame frame, elvis_vec3 slope) {
    const elvis_real bent_off = core_value_bent_off(interval, bend, frame, slope);
    const elvis_real linear = elvis_real(4) * CORE_ROUNDOFF * interval.radius;
#if ELVIS_REAL_IS_DOUBLE
    // Rounding is small as it is, and registers are few.
    return bent_off + core_model_norm1(slope) * (interval.beyond - interval.bent_off + linear);
#else
    // A position that is off moves the field by its gradient in the world: in elements whose Jacobian is nearly singular, that is far less
    // than what the reference coordinates are off would make of its slope.
    const elvis_real by_position = dot(abs(core_to_world(frame, slope)), frame.position_error);
    // Of the Jacobian, relative to the element's size, and of its inverse: cofactors, and the determinant.
    const elvis_vec3 offset = max(abs(interval.q + interval.low * interval.w), abs(interval.q + interval.high * interval.w));
    const elvis_real by_inverse = frame.conditioning * dot(abs(slope), offset + interval.way / frame.lengths);
    return bent_off + core_model_norm1(slope) * linear + (elvis_real(1) + elvis_real(4) * interval.radius) * by_position +
           elvis_real(8) * CORE_ROUNDOFF * by_inverse;
#endif
}

void core_interval_take_field(inout core_ray_interval interval, uint element, elvis_vec3 xi, const core_frame frame,
                              const core_interval_bend bend, out core_model model, out elvis_real value) {
    core_region region;
    region.corner0 = interval.q + interval.low * interval.w;
    region.corner1 = interval.q + interval.high * interval.w;
    // Two would do, but estimates look at all four (field/estimated_model.glsl).
    region.corner2 = interval.q + elvis_real(0.5LF) * interval.low * interval.w;
    region.corner3 = interval.q + elvis_real(0.5LF) * interval.high * interval.w;
    region.beyond = interval.beyond;
    region.radius = interval.radius;
    model = core_shown_model(element, xi, region, value);
    interval.value = model.value + dot(model.slope, interval.q);
    interval.slope = dot(model.slope, interval.w);
    interval.error = CORE_MODEL_UP * (model.remainder + core_value_off(interval, bend, frame, model.slope)) +
                  elvis_real(4) * CORE_ROUNDOFF * abs(model.value) + CORE_MODEL_TINY;
    interval.is_known = core_model_is_known(model);
}

// The first isovalue that the field may take along the interval, and where.
struct core_linear_root {
    // None is taken for certain.
    bool is_excluded;
    // No other one can be taken.
    bool is_only;
    elvis_real isovalue;
    // It is taken within half_width of s, if at all in the element; nothing is taken before.
    elvis_real s, half_width;
};

core_linear_root core_first_linear_root(core_ray_interval interval) {
    const elvis_real a = interval.value + interval.low * interval.slope, b = interval.value + interval.high * interval.slope;
    const elvis_real least = min(a, b) - interval.error, most = max(a, b) + interval.error;
    const uint first = core_isovalue_from(least);
    const uint last = core_isovalues_end(first, most);
    const uint next = interval.slope > elvis_real(0) ? first : max(last, 1u) - 1u;
    core_linear_root candidate;
    candidate.is_excluded = interval.is_known && first == last;
    candidate.is_only = interval.is_known && last == first + 1u;
    candidate.isovalue = core_isovalue_at(min(next, CORE_N_ISOVALUES - 1u));
    const elvis_real inverse = elvis_real(1) / interval.slope;
    candidate.s = (candidate.isovalue - interval.value) * inverse;
    candidate.half_width = interval.error * abs(inverse);
    return candidate;
}
