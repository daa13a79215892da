// A ray in one element, to first order: the reference coordinates of its points as predicted by a Newton step from one point of the
// element, how far off they may be (element/prediction.glsl), and what the faces, which are linear in them, make of that:
//
//   possible   the ray may be inside: outside of this interval it surely violates a face
//   sure       it surely is: every face is kept by more than the error
//   from, to   where it enters and leaves as predicted
//
// All within the interval that the error was bounded on.

#ifndef CORE_RAY_MODEL
#define CORE_RAY_MODEL

#include "element/element_frame.glsl"
#include "element/inside.glsl"
#include "element/prediction.glsl"
#include "element/shape_region.glsl"
#include "segments/ray_point.glsl"

#define CORE_NO_FACE -1

// Whether it is remembered where a ray enters the element that it is followed in, and the last point but one. Elsewhere registers are
// worth more.
#ifndef CORE_REMEMBERS_ENTRY
#define CORE_REMEMBERS_ENTRY 0
#endif

// No point of the shape is farther from its centroid, in the maximum norm.
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
#define CORE_SHAPE_RADIUS elvis_real(1)
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM
#define CORE_SHAPE_RADIUS (elvis_real(4) / elvis_real(3))
#else
#define CORE_SHAPE_RADIUS elvis_real(1.5LF)
#endif

struct core_ray_model {
    // Prediction at the parameter `anchor`, and how it changes with it.
    elvis_vec3 at, slope;
    elvis_real anchor;
    // From the point that the prediction was made from.
    elvis_vec3 newton_step;
    // Rounding of the coordinates.
    elvis_vec3 noise;
#if ELVIS_HAS_INSIDE
    // The element's own boundary (element/inside.glsl); its tangent as a constraint; how far from the point that the
    // prediction was made from the interval's points in the element are at most.
    core_inside own;
    elvis_vec4 own_tangent;
    elvis_real own_reach;
#endif
};

#if ELVIS_HAS_INSIDE
elvis_vec4 core_side_constraint(core_ray_model model, int side) {
    return side == CORE_INSIDE_FACE ? model.own_tangent : core_face_constraint(side);
}
// What the constraint is off within this distance.
elvis_real core_side_bend(core_ray_model model, int side, elvis_real reach) {
    return side == CORE_INSIDE_FACE ? core_inside_bend(model.own, reach) : elvis_real(0);
}
elvis_real core_interval_bend(core_ray_model model, int side) { return core_side_bend(model, side, model.own_reach); }
elvis_real core_side_noise(core_ray_model model, int side) {
    return dot(abs(core_side_constraint(model, side).xyz), model.noise) + (side == CORE_INSIDE_FACE ? model.own.rounding : elvis_real(0));
}

// How far along the ray rounding may move it, to either side.
elvis_real core_own_blur(core_ray_model model) {
    const elvis_real slope = max(abs(dot(model.own_tangent.xyz, model.slope)), elvis_real(1e-30LF));
    return elvis_real(4) * core_side_noise(model, CORE_INSIDE_FACE) / slope;
}

// As if there were none.
void core_set_no_inside(inout core_ray_model model) {
    model.own = core_inside(elvis_real(-1), elvis_vec3(0), elvis_real(0), elvis_real(0), elvis_real(0));
    model.own_tangent = elvis_vec4(0, 0, 0, -1);
    model.own_reach = elvis_real(0);
}

// At xi, where the mapping was evaluated.
void core_evaluate_inside(inout core_ray_model model, uint element, elvis_vec3 xi, elvis_real reach) {
    model.own = core_inside_at(element, xi);
    model.own_tangent = elvis_vec4(model.own.slope, model.own.value - dot(model.own.slope, xi));
    model.own_reach = reach;
}
#else
#define core_side_constraint(model, side) core_face_constraint(side)
#define core_side_bend(model, side, reach) elvis_real(0)
#define core_interval_bend(model, side) elvis_real(0)
#define core_side_noise(model, side) dot(abs(core_face_constraint(side).xyz), model.noise)
#endif

// Length of the Newton step that leads to the prediction at t.
elvis_real core_model_step(core_ray_model model, elvis_real t) {
    const elvis_vec3 step = abs(model.newton_step + (t - model.anchor) * model.slope);
    return max(max(step.x, step.y), step.z);
}

// Newton's method surely converges from there (Kantorovich), so that what is predicted inside exists.
bool core_is_near(elvis_real curvature, elvis_real step) { return elvis_real(4) * curvature * step < elvis_real(1); }

struct core_ray_clip {
    elvis_real possible_from, possible_to, sure_from, sure_to, from, to;
    // What is surely inside is known, and not empty.
    bool is_sure;
    // The faces that bound from and to; CORE_NO_FACE where the interval does.
    int from_face, to_face;
#if ELVIS_HAS_INSIDE
    // The element's own boundary is what keeps the ray from being surely inside from earlier on, or until later.
    bool own_holds_from, own_holds_to;
#endif
};

// By how much the slope may differ where the point is no farther than `distance` from the one that the model was made from.
elvis_real core_slope_change(core_ray_model model, elvis_real curvature, elvis_real distance) {
    // J^-1 changes by a share of 2 C d / (1 - 2 C d).
    const elvis_real share = elvis_real(2) * curvature * distance;
    return share < elvis_real(0.5LF) ? core_max_norm(model.slope) * share / (elvis_real(1) - share) : elvis_real(1e30LF);
}

// Where the ray enters an element, or is in it, with the curvature there; CORE_UNKNOWN_CURVATURE if it is not known.
struct core_ray_entry {
    core_ray_point point;
    elvis_real curvature;
};

// From the entry on, how long in the ray's parameter it surely stays inside of a face by which it enters. Over steps of at most a fifth
// of 1 / C predictions are off by 2 C times the step's square at most (core_prediction_error).
elvis_real core_entry_reach(const core_ray_entry entry, elvis_vec3 normal, elvis_real norm) {
    const elvis_vec3 slope = core_slope_of(entry.point);
    const elvis_real speed = core_max_norm(slope), rate = max(-dot(normal, slope), elvis_real(0));
    return min(rate / (elvis_real(2) * norm * speed), elvis_real(0.2LF)) / (entry.curvature * speed);
}

// Within [begin, end], where predictions are off by at most `error`, and slopes by `slope_change`. `is_inside`: the ray is inside at
// `begin`, so that a face of the shape by which it surely enters does not bound what is sure. `is_confirmed`: then such a face does not
// limit the possible interval either, because rounding could place the ray just outside. A face that the ray runs along within rounding
// bounds nothing: rays in a face that two elements share lie in both.
// `entry`: where the ray enters the element, or is in it; what is known from there.
core_ray_clip core_clip_ray(core_ray_model model, elvis_real error, elvis_real slope_change, bool is_inside, bool is_confirmed,
                            const core_ray_entry entry, elvis_real begin, elvis_real end) {
    const elvis_real low = begin - model.anchor, high = end - model.anchor;
    const elvis_real tiny = elvis_real(1e-30LF);
    // Over the length of the shape, however short the interval: else every face would be one that the ray runs along in the end.
    const elvis_real length = max(high - low, elvis_real(1) / max(core_max_norm(model.slope), tiny));
    core_ray_clip clip;
    clip.possible_from = clip.sure_from = clip.from = low;
    clip.possible_to = clip.sure_to = clip.to = high;
    clip.from_face = clip.to_face = CORE_NO_FACE;
    for (int face = 0; face < CORE_N_SIDES; ++face) {
        const elvis_vec4 constraint = core_side_constraint(model, face);
        const elvis_vec3 size = abs(constraint.xyz);
        const elvis_real noise = core_side_noise(model, face);
        const elvis_real slope = dot(constraint.xyz, model.slope);
        const bool is_along = face < CORE_N_FACES && abs(slope) * length <= noise;
        const elvis_real value = dot(constraint.xyz, model.at) + constraint.w - (is_along ? elvis_real(3) * noise : elvis_real(0));
        const elvis_real slack = (size.x + size.y + size.z) * error + core_interval_bend(model, face) +
                                 (is_along ? elvis_real(0) : noise);
        const bool is_leaving = slope >= elvis_real(0);
        const elvis_real inverse = elvis_real(1) / max(abs(slope), tiny);
        const elvis_real sign = is_leaving ? elvis_real(-1) : elvis_real(1);
        const elvis_real root = sign * value * inverse;
        const elvis_real inner = sign * (value + slack) * inverse, outer = sign * (value - slack) * inverse;
        const bool is_first_to = is_leaving && root < clip.to, is_last_from = !is_leaving && root > clip.from;
        clip.to = is_first_to ? root : clip.to;
        clip.to_face = is_first_to ? face : clip.to_face;
        clip.from = is_last_from ? root : clip.from;
        clip.from_face = is_last_from ? face : clip.from_face;
#if ELVIS_HAS_INSIDE
        // It comes last.
        clip.own_holds_from = !is_leaving && inner > clip.sure_from;
        clip.own_holds_to = is_leaving && inner < clip.sure_to;
#endif
        clip.possible_to = is_leaving ? min(clip.possible_to, outer) : clip.possible_to;
        clip.sure_to = is_leaving ? min(clip.sure_to, inner) : clip.sure_to;
        const elvis_real norm = size.x + size.y + size.z;
        bool is_entered = slope < -norm * slope_change;
#if CORE_REMEMBERS_ENTRY
        is_entered = is_entered || inner <= (entry.point.t - model.anchor) + core_entry_reach(entry, constraint.xyz, norm);
#endif
        const bool is_kept = is_inside && face < CORE_N_FACES && is_entered;
        clip.possible_from = is_leaving || (is_kept && is_confirmed) ? clip.possible_from : max(clip.possible_from, outer);
        clip.sure_from = is_leaving || is_kept ? clip.sure_from : max(clip.sure_from, inner);
    }
    // The interval's ends themselves without rounding, so that they can be told.
    clip.possible_from = clip.possible_from <= low ? begin : model.anchor + clip.possible_from;
    clip.possible_to = clip.possible_to >= high ? end : model.anchor + clip.possible_to;
    clip.sure_from = clip.sure_from <= low ? begin : model.anchor + clip.sure_from;
    clip.sure_to = clip.sure_to >= high ? end : model.anchor + clip.sure_to;
    clip.from += model.anchor;
    clip.to += model.anchor;
    return clip;
}

struct core_root_error {
    // Of the boundary, in world length; of the parameter, rounding included.
    elvis_real distance, parameter;
};

core_root_error core_root_error_at(core_ray_model model, core_frame frame, elvis_real curvature, int face, elvis_real root) {
    const elvis_vec4 constraint = core_side_constraint(model, max(face, 0));
    const elvis_vec3 size = abs(constraint.xyz);
    const elvis_real step = core_model_step(model, root), left = core_prediction_error(curvature, step);
    const elvis_real error = (size.x + size.y + size.z) * left + core_side_bend(model, face, step + left);
    const elvis_vec3 normal = constraint.x * frame.row0 + constraint.y * frame.row1 + constraint.z * frame.row2;
    const elvis_real slope = max(abs(dot(constraint.xyz, model.slope)), elvis_real(1e-30LF));
    const bool is_face = face >= 0;
    return core_root_error(is_face ? error * inversesqrt(dot(normal, normal)) : elvis_real(0),
                           is_face ? (error + core_side_noise(model, max(face, 0))) / slope : elvis_real(0));
}

#endif
