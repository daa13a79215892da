// The shown field at points of a ray inside an element, found by Newton's method, one evaluation of mapping and field a step.
//
// The point wanted next is predicted from the last one found, with the Jacobian there. Where Newton's method does not find it
// from so far away, a point half the way is found first, and so on: the prediction is then followed along the ray.
//
// The field is taken to first order from the point that was evaluated, so that what Newton's method leaves counts twice only. Its
// error is bounded as in isosurface/ray_interval.glsl.
//
// A sample is good enough where the bounds of its errors say so, else where Newton's method has come to rest.
//
// The kernel brings segments/segment.glsl and field/shown_model.glsl.

#define CORE_SAMPLE_RUNNING 0u
#define CORE_SAMPLE_FOUND 1u
#define CORE_SAMPLE_FAILED 2u

// Steps towards one point, before one half the way is looked for; and in all.
#define CORE_SAMPLE_STEPS 8u
#define CORE_SAMPLE_MOST_STEPS 64u

struct core_follower {
    // The last point that was found, and the one before that; the same one if there is none.
    core_ray_point known, before;
    // Parameter wanted in the end, and the one that is looked for; the prediction for that, from the first step on.
    elvis_real goal, at, x, y, z;
    // How far from the goal on, or back, `bend` is wanted; error of the field that is good enough.
    elvis_real span, enough;
    uint steps, all_steps;
};

struct core_ray_sample {
    uint status;
    // Of the field at the parameter, its change with it, and its error.
    elvis_real value, slope, error, slope_error;
    // How far the field may be from the line through value and slope, over the follower's span.
    elvis_real bend;
    bool is_known;
    // Of the point in reference coordinates: offset of the point from xi, change with the parameter, rounding.
    elvis_vec3 xi, q, w;
    elvis_real rounding, beyond;
    // Of the field in reference coordinates, and J^-1.
    elvis_vec3 gradient;
    core_frame frame;
    bool is_finite;
};

core_follower core_follow_from(core_ray_point known, core_ray_point before) {
    core_follower follower;
    follower.known = known;
    follower.before = before;
    return follower;
}

elvis_vec3 core_predict_point(const core_follower follower) {
    // Far predictions are of no use but for their direction, and could overflow.
    return clamp(core_predicted_by_two(follower.known, follower.before, follower.at), elvis_vec3(-4), elvis_vec3(4));
}

void core_follow_to(inout core_follower follower, elvis_real goal, elvis_real span, elvis_real enough) {
    follower.goal = follower.at = goal;
    follower.span = span;
    follower.enough = enough;
    follower.steps = follower.all_steps = 0u;
}

// The field at a point of the ray that is off by `off` and `rounding` at most, and how far it may be from a line over the span. `step`: of
// Newton's method that led there; `far_step`: that to the farthest point of the span. The change of the point with the parameter is that
// where the step began.
void core_sample_field(uint element, elvis_vec3 point, elvis_real off, elvis_vec3 rounding, elvis_real step, elvis_real far_step,
                       elvis_real curvature, elvis_real span, inout core_ray_sample result) {
    result.rounding = core_max_norm(rounding);
    result.beyond = off + result.rounding;
    elvis_real x = point.x, y = point.y, z = point.z;
    // Or at the nearest point of the shape.
    core_project(x, y, z);
    result.xi = elvis_vec3(x, y, z);
    result.q = point - result.xi;
    const elvis_real outside = core_max_norm(result.q);
    const elvis_vec3 far = result.q + span * result.w;
    core_region region;
    region.corner0 = region.corner1 = result.q;
    region.corner2 = region.corner3 = far;
    region.beyond = result.beyond;
    region.radius = max(outside, core_max_norm(far)) + result.beyond;
    elvis_real value;
    const core_model model = core_shown_model(element, result.xi, region, value);
    result.gradient = model.slope;
    const elvis_real size = core_model_norm1(model.slope);
    const elvis_real blur = dot(abs(model.slope), rounding) + size * (off + elvis_real(4) * CORE_ROUNDOFF * outside);
    result.is_known = core_model_is_known(model);
    result.value = result.is_known ? model.value + dot(model.slope, result.q) : value;
    result.slope = dot(model.slope, result.w);
    // Remainders go with the square of the distance, but for rounding.
    const elvis_real share = (outside + result.beyond) / region.radius;
    const elvis_real remainder = region.radius > elvis_real(0) ? model.remainder * share * share : model.remainder;
#ifdef CORE_SHOWN_BY_EXPRESSION
    const elvis_real of_value = CORE_MODEL_OPERATIONS * CORE_ROUNDOFF * (abs(model.value) + size * outside);
#else
    const elvis_real of_value = core_shown_rounding(element, result.xi);
#endif
    // Without a model: what rounding alone does.
    result.error = (result.is_known ? CORE_MODEL_UP * (remainder + blur) + of_value
                                    : elvis_real(64) * CORE_ROUNDOFF * abs(value) + blur) +
                   elvis_real(4) * CORE_ROUNDOFF * abs(model.value) + CORE_MODEL_TINY;
    result.bend = result.is_known ? model.remainder + size * core_prediction_error(curvature, max(step, far_step)) : CORE_UNKNOWN;
    const elvis_real speed = core_max_norm(result.w);
    result.slope_error = elvis_real(2) * remainder / max(outside + result.beyond, elvis_real(1e-30LF)) * speed +
                         elvis_real(2) * curvature * step * size * speed;
    result.is_finite = core_is_finite(value);
}

// What the slope is off does to a polynomial over the span, which has slopes at both ends: an eighth.
bool core_sample_is_enough(const core_ray_sample result, elvis_real span, elvis_real enough) {
    return result.is_known && result.error + elvis_real(0.125LF) * abs(span) * result.slope_error <= enough;
}

// One evaluation.
core_ray_sample core_sample_step(const core_traced_ray ray, uint element, elvis_real element_curvature, inout core_follower follower) {
    core_ray_sample result;
    if (follower.steps == 0u) {
        const elvis_vec3 predicted = core_predict_point(follower);
        follower.x = predicted.x;
        follower.y = predicted.y;
        follower.z = predicted.z;
    }
    elvis_real x = follower.x, y = follower.y, z = follower.z;
    core_project(x, y, z);
    const elvis_vec3 xi = elvis_vec3(x, y, z);
    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, position, jacobian);
    const elvis_vec3 shift = CORE_CENTRE - elvis_origin(element), way = follower.at * ray.direction;
    result.frame = core_frame_at(position, jacobian,
                                 ray.error + elvis_real(2) * CORE_ROUNDOFF * (core_max_norm(shift) + core_max_norm(way)));
    const elvis_real curvature = core_curvature_at(element, result.frame, element_curvature);
    const elvis_vec3 newton = core_to_xi(result.frame, ((shift - position) + ray.origin) + way);
    result.w = core_to_xi(result.frame, ray.direction);
    const elvis_vec3 found = xi + newton;
    const elvis_real change = core_max_norm(found - elvis_vec3(follower.x, follower.y, follower.z));
    const elvis_real step = core_max_norm(newton);
    // Where the bound says nothing, two predictions that agree do, as in element/newton.glsl.
    const elvis_real off = min(core_prediction_error(curvature, step), change);

    core_sample_field(element, found, off, result.frame.xi_error, step, core_max_norm(newton + follower.span * result.w), curvature,
                      follower.span, result);
    const bool is_enough = core_sample_is_enough(result, follower.span, follower.enough);
    result.is_finite = result.is_finite && core_is_finite(core_max_norm(position));

    const bool is_sound = result.frame.is_sound && core_is_finite(step + core_max_norm(result.w));
    const bool has_converged = change <= elvis_real(4) * result.rounding;
    const bool is_found = is_sound && (has_converged || is_enough);
    result.error += has_converged ? elvis_real(0) : elvis_real(0.125LF) * abs(follower.span) * result.slope_error;
    follower.steps += 1u;
    follower.all_steps += 1u;
    const bool is_stuck = !is_found && (!is_sound || follower.steps >= CORE_SAMPLE_STEPS);
    const bool is_there = is_found && follower.at == follower.goal;
    follower.before = core_either(is_found, follower.known, follower.before);
    follower.known = core_either(is_found, core_ray_point_at(follower.at, found, result.w), follower.known);
    const elvis_real limit = elvis_real(4);
    follower.x = is_sound ? clamp(found.x, -limit, limit) : follower.x;
    follower.y = is_sound ? clamp(found.y, -limit, limit) : follower.y;
    follower.z = is_sound ? clamp(found.z, -limit, limit) : follower.z;
    if (is_stuck || (is_found && !is_there)) {
        follower.at = is_found ? follower.goal : elvis_real(0.5LF) * (follower.known.t + follower.at);
        follower.steps = 0u;
    }
    const bool is_given_up = follower.all_steps >= CORE_SAMPLE_MOST_STEPS;
    result.status = is_there ? CORE_SAMPLE_FOUND : is_given_up ? CORE_SAMPLE_FAILED : CORE_SAMPLE_RUNNING;
    return result;
}

// The field at the ray's point at `at`, as it is predicted from the evaluation of the mapping that found where the ray leaves, or enters if
// it `is_entry`: another one is not needed if that was near enough, which the status says.
core_ray_sample core_sample_predicted(const core_segment segment, bool is_entry, elvis_real at, elvis_real span, elvis_real enough) {
    core_ray_sample result;
    is_entry = is_entry && CORE_REMEMBERS_ENTRY == 1;
    const core_ray_point from = core_either(is_entry, segment.entry.point, segment.anchor);
    const elvis_real curvature = is_entry ? segment.entry.curvature : segment.anchor_curvature;
    const elvis_vec3 noise = is_entry ? elvis_vec3(segment.entry_noise) : segment.noise;
    result.w = core_slope_of(from);
    const elvis_real speed = core_max_norm(result.w);
    const elvis_real step = (is_entry ? segment.entry_step : segment.newton_step) + abs(at - from.t) * speed;
    const elvis_real off = core_prediction_error(curvature, step);
    core_sample_field(segment.element, core_predicted(from, at), off, noise, step, step + abs(span) * speed, curvature, span, result);
    const bool is_enough = core_sample_is_enough(result, span, enough);
    const bool has_converged = result.is_known && off <= elvis_real(3) * result.rounding;
    result.error += has_converged ? elvis_real(0) : elvis_real(0.125LF) * abs(span) * result.slope_error;
    result.status = (is_enough || has_converged) && result.is_finite && step < elvis_real(1) ? CORE_SAMPLE_FOUND : CORE_SAMPLE_RUNNING;
    return result;
}
