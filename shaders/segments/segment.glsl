// The segments of a ray in one element, one after the other, one evaluation of the mapping an iteration.
//
// Each iteration looks at an interval of the ray, [begin, end], up to which everything is decided: the ray is outside before `begin`, or,
// once it has entered, inside. The mapping is evaluated at the point predicted for a parameter in the interval; that splits it
// into what is outside, what is inside and what is open (segments/ray_model.glsl). The open interval around a single crossing is the
// next interval, with the crossing as predicted as its parameter: Newton's method, whose bounds shrink quadratically. Where an
// interval does not shrink by half its first half is next. So a segment is found however often the ray crosses a face, and faces
// are never extrapolated beyond where the bound holds.
//
// The first split comes from the linearized mapping without any evaluation (element/linearization.glsl); it dismisses most elements
// that are missed.
//
// The kernel brings core_ray; CORE_CENTRE, the world's coordinates of the hierarchies' origin; and the buffers core_elements and
// core_links.

#include "element/linearization.glsl"
#include "element/local_curvature.glsl"
#include "segments/ray_model.glsl"
#include "segments/ray_point.glsl"
#include "segments/traced_ray.glsl"

// The linearized mapping keeps this many digits of coordinates in the element.
#define CORE_START_ERROR elvis_real(1e-2LF)

// The search uses this curvature where the true one is larger or unknown, and a share of the curvature after too many iterations. Segments
// are estimated in both cases. A kernel may bring other numbers: a larger one is valid for more elements, but needs more iterations.
#ifndef CORE_ASSUMED_CURVATURE
#define CORE_ASSUMED_CURVATURE elvis_real(4)
#define CORE_CERTAIN_ITERATIONS 64u
#define CORE_SEGMENT_ITERATIONS 128u
#endif
// In the record of core_links, behind the faces.
#ifndef CORE_LINKS_CURVATURE
#define CORE_LINKS_CURVATURE 7u
#endif
// A kernel without core_links has it from elsewhere.
#ifndef CORE_SEGMENT_CURVATURE
#define CORE_SEGMENT_CURVATURE(element) elvis_real(uintBitsToFloat(elvis_fetch_core_links(element, CORE_LINKS_CURVATURE)))
#endif

// Newton's method for where a ray enters: starts, and steps from each.
#define CORE_ENTER_STARTS 10u
#define CORE_ENTER_STEPS 12u
// Least curvature of elements in which rays are followed from there: with less, no two points that are both in the element's
// neighbourhood are taken for each other.
#define CORE_FOLLOWED_CURVATURE elvis_real(0.25LF)
// Where predictions are better than this share of rounding, another one is no better.
#define CORE_PREDICTION_SHARE elvis_real(0.5LF)
// Of tolerances.
#define CORE_MOST_BLUR elvis_real(64)
// Cut elements have ends of two kinds, and are asked for more of both.
#define CORE_ITERATIONS_SHARE (1u + 2u * uint(ELVIS_HAS_INSIDE))
// Whether there may be such elements: code for them makes loops slower even where it is not reached.
#ifndef CORE_HAS_CURVED
#define CORE_HAS_CURVED 1
#endif

// Of a point that no evaluation has led to.
#define CORE_NO_STEP elvis_real(3e38LF)

#define CORE_SEGMENT_OPEN 0u
#define CORE_SEGMENT_FOUND 1u
#define CORE_SEGMENT_NONE 2u

struct core_segment {
    uint element;
    bool is_inside, is_estimated, has_failed;
    // The last iteration has left out what may be inside: from `enter` on, over `enter_error`.
    bool is_touched;
    // Inside as the neighbour says, which nothing has confirmed yet.
    bool is_assumed;
    // From a point in the element (core_segment_enter): predictions only count as far as they surely follow it.
    bool is_followed;
    // The interval, the end of what is open, and the parameter to evaluate at.
    elvis_real begin, end, last, next;
    // Known to be inside from an earlier iteration; empty if from > to.
    elvis_real known_from, known_to;
    elvis_real enter, enter_error, leave, leave_error;
    // CORE_NO_FACE where they are not known.
    int enter_face, leave_face;
    // Where the search goes on after the segment, if before `last`.
    elvis_real resume;
    // The last prediction and the one before it, the same one if there is none: the next point comes from them.
    core_ray_point anchor, before;
    // Length of the step that led to it, and rounding of its coordinates.
    elvis_real newton_step;
    elvis_vec3 noise;
    // Of the element, and for predictions from the anchor.
    elvis_real curvature, anchor_curvature;
    // Where the ray has been found to enter (core_segment_enter), with the same numbers of that prediction.
    core_ray_entry entry;
    elvis_real entry_step, entry_noise;
    uint iterations;
};

core_segment core_no_segment() {
    core_segment segment;
    segment.element = 0u;
    segment.next = elvis_real(0);
    segment.anchor = segment.before = core_ray_point_at(elvis_real(0), elvis_vec3(0), elvis_vec3(0));
    segment.iterations = 0u;
    return segment;
}

elvis_vec3 core_segment_target(const core_traced_ray ray, uint element, elvis_real t) {
    // elvis_origin is zero where the snippet's coordinates are the world's.
    return (CORE_CENTRE - elvis_origin(element)) + (ray.origin + t * ray.direction);
}

// Starts with what lies in [begin, end]. False if the ray surely misses the element there. `is_entered`: the caller says that the ray
// enters at `begin`. The search assumes so until a bound contradicts it.
bool core_segment_begin(const core_traced_ray ray, uint element, elvis_real begin, elvis_real end, bool is_entered,
                        out core_segment segment) {
    const core_linearization linearization = core_fetch_linearization(element);
    const bool is_linearized = linearization.exponents != 0u;
    const elvis_vec3 first = core_segment_target(ray, element, begin);
    const elvis_vec3 second = first + ray.longest * ray.direction;
    const elvis_vec3 here = elvis_vec3(core_linear_inverse(linearization, vec3(first)));
    const elvis_vec3 there = elvis_vec3(core_linear_inverse(linearization, vec3(second)));
    const elvis_real curvature = CORE_SEGMENT_CURVATURE(element);
    core_ray_model model;
    model.at = here;
    model.slope = (there - here) / ray.longest;
    model.anchor = begin;
    model.newton_step = model.noise = elvis_vec3(0);
#if ELVIS_HAS_INSIDE
    core_set_no_inside(model);
#endif
    // Points of the shape are no farther away than its radius, wherever they are predicted.
    const elvis_real error = curvature * CORE_SHAPE_RADIUS * CORE_SHAPE_RADIUS + CORE_START_ERROR;
    const core_ray_entry entry = core_ray_entry(core_ray_point_at(begin, here, model.slope), CORE_UNKNOWN_CURVATURE);
    const core_ray_clip clip =
        core_clip_ray(model, is_linearized ? error : elvis_real(1e6LF), elvis_real(0), false, false, entry, begin, end);
    const bool is_possible = clip.possible_from <= clip.possible_to && begin < end;
    // Without an evaluation nothing is known of the element's own boundary.
    const bool is_sure =
        ELVIS_HAS_INSIDE == 0 && is_linearized && core_is_near(curvature, CORE_SHAPE_RADIUS) && clip.sure_from <= clip.sure_to;

    segment.element = element;
    segment.is_estimated = !is_linearized || curvature > CORE_ASSUMED_CURVATURE;
    segment.has_failed = segment.is_touched = false;
    segment.curvature = segment.is_estimated ? CORE_ASSUMED_CURVATURE : curvature;
    segment.anchor_curvature = segment.curvature;
    segment.is_followed = false;
    segment.is_assumed = ELVIS_HAS_INSIDE == 0 && is_entered && !is_sure && clip.possible_from <= begin;
    segment.is_inside = segment.is_assumed || (is_sure && (is_entered || clip.sure_from <= begin));
    segment.last = clip.possible_to;
    segment.begin = segment.is_inside && is_sure ? clip.sure_to : clip.possible_from;
    segment.end = is_sure && !segment.is_inside ? clip.sure_from : clip.possible_to;
    segment.next = elvis_real(0.5LF) * (segment.begin + segment.end);
    segment.known_from = is_sure ? clip.sure_from : elvis_real(3e38LF);
    segment.known_to = is_sure ? clip.sure_to : elvis_real(-3e38LF);
    segment.enter = begin;
    segment.enter_face = segment.leave_face = CORE_NO_FACE;
    segment.enter_error = segment.leave = segment.leave_error = segment.resume = elvis_real(0);
    segment.anchor = core_either(is_linearized, core_ray_point_at(begin, here, model.slope),
                                 core_ray_point_at(begin, CORE_CENTROID, elvis_vec3(0)));
    segment.before = segment.anchor;
    segment.entry = core_ray_entry(segment.anchor, CORE_UNKNOWN_CURVATURE);
    segment.newton_step = segment.entry_step = CORE_NO_STEP;
    segment.entry_noise = elvis_real(0);
    segment.noise = elvis_vec3(0);
    segment.iterations = 0u;
    return is_possible;
}

// What an evaluation of the mapping at a point xi of the element tells of the ray at t.
struct core_ray_evaluation {
    core_ray_model model;
    core_frame frame;
    bool is_sound;
};

core_ray_evaluation core_evaluate_ray(const core_traced_ray ray, uint element, elvis_vec3 xi, elvis_real t) {
    core_ray_evaluation here;
    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, position, jacobian);
    here.frame = core_frame_at(position, jacobian, ray.error);
    here.model.newton_step = core_to_xi(here.frame, core_segment_target(ray, element, t) - position);
    here.model.at = xi + here.model.newton_step;
    here.model.slope = core_to_xi(here.frame, ray.direction);
    here.model.anchor = t;
    here.model.noise = here.frame.xi_error;
    here.is_sound = here.frame.is_sound && core_is_finite(here.model.newton_step.x + here.model.newton_step.y + here.model.newton_step.z);
    return here;
}

// The curvature of the element is larger than the one that is assumed, or unknown.
bool core_is_assumed(const core_segment segment) { return segment.curvature >= CORE_ASSUMED_CURVATURE; }

// As it counts for predictions from an evaluation. A search that is estimated does not wait for what is proven.
elvis_real core_segment_curvature(uint element, const core_frame frame, const core_segment segment) {
    return segment.is_estimated && !segment.is_followed ? min(core_proven_curvature_at(element, frame), segment.curvature)
                                                        : core_curvature_at(element, frame, segment.curvature);
}

// How far a prediction may lead in reference coordinates before another point than the ray's may be nearer: half as far as there is
// surely no other one (Kantorovich).
elvis_real core_follow_span(elvis_real curvature) { return elvis_real(0.5LF) / curvature; }

// Of an interval that an evaluation in its middle surely bounds (core_is_near), with something to spare.
elvis_real core_sure_span(elvis_real curvature) { return elvis_real(0.33LF) / curvature; }

// In elements so curved that a point outside of them may be taken for the ray's, the ray is followed from where it enters: there its
// point lies in the element, and is found by Newton's method from one start after the other. False if it is not. `slack`: by how much of
// the parameter it may be off.
bool core_segment_enter(const core_traced_ray ray, elvis_real slack, inout core_segment segment) {
    uint start = 0u, steps = 0u;
    bool is_found = false, is_proven = false;
    elvis_real x = segment.anchor.x, y = segment.anchor.y, z = segment.anchor.z;
    core_project(x, y, z);
    const uint element = segment.element;
    while (!is_found && start < CORE_ENTER_STARTS) {
        const core_ray_evaluation here = core_evaluate_ray(ray, element, elvis_vec3(x, y, z), segment.anchor.t);
        const elvis_vec3 at = here.model.at, slope = here.model.slope;
        const elvis_real noise = core_max_norm(here.model.noise), size = core_max_norm(here.model.newton_step);
        const elvis_real beyond = core_excess(at.x, at.y, at.z);
        const elvis_real curvature = core_curvature_at(element, here.frame, segment.curvature);
        const bool is_there = here.frame.is_sound && core_is_near(curvature, size) && size <= max(elvis_real(4) * noise, elvis_real(1e-3LF));
        const bool is_in = beyond <= CORE_CONSTRAINT_NORM * (elvis_real(8) * noise + slack * core_max_norm(slope) +
                                                             elvis_real(2) * curvature * size * size);
        steps += 1u;
        segment.iterations += 1u;
        is_found = is_there && is_in;
        segment.anchor = core_either(is_found, core_ray_point_at(segment.anchor.t, at, slope), segment.anchor);
        segment.anchor_curvature = is_found ? curvature : segment.anchor_curvature;
        segment.newton_step = is_found ? size : segment.newton_step;
        segment.entry_noise = noise;
        is_proven = core_proven_curvature_at(element, here.frame) < CORE_UNKNOWN_CURVATURE;
        // From the centroid, then from near the corners.
        const bool is_failed = !here.frame.is_sound || (is_there && !is_in) || steps >= CORE_ENTER_STEPS;
        const elvis_real out_to = start == 0u ? elvis_real(0) : elvis_real(0.7LF);
        x = is_failed ? CORE_CENTROID.x + ((start & 1u) == 0u ? out_to : -out_to) : at.x;
        y = is_failed ? CORE_CENTROID.y + ((start & 2u) == 0u ? out_to : -out_to) : at.y;
        z = is_failed ? CORE_CENTROID.z + ((start & 4u) == 0u ? out_to : -out_to) : at.z;
        start += is_failed ? 1u : 0u;
        steps = is_failed ? 0u : steps;
        core_project(x, y, z);
    }
    const elvis_real rate = core_max_norm(core_slope_of(segment.anchor));
    segment.before = segment.anchor;
    segment.entry = core_ray_entry(segment.anchor, is_found ? segment.anchor_curvature : CORE_UNKNOWN_CURVATURE);
    segment.entry_step = segment.newton_step;
    segment.is_followed = is_found;
    segment.is_estimated = segment.is_estimated && !(is_found && is_proven);
    segment.is_inside = segment.is_inside || is_found;
    segment.is_assumed = is_found;
    segment.begin = is_found ? segment.anchor.t : segment.begin;
    segment.last = max(segment.last, segment.begin);
    segment.end = is_found ? min(segment.last, segment.anchor.t + core_sure_span(segment.anchor_curvature) / rate) : segment.end;
    segment.next = is_found ? elvis_real(0.5LF) * (segment.begin + segment.end) : segment.next;
    return is_found;
}

#include "segments/segment_ends.glsl"

// After too many iterations a share of the bound is taken for it.
elvis_real core_assumed_curvature(elvis_real curvature, uint iterations) {
    const bool is_certain = iterations <= CORE_CERTAIN_ITERATIONS * CORE_ITERATIONS_SHARE;
    const bool is_late = iterations >= CORE_CERTAIN_ITERATIONS * CORE_ITERATIONS_SHARE + 32u;
    return is_certain ? curvature : curvature * (is_late ? elvis_real(0.015625LF) : elvis_real(0.125LF));
}

// What of the interval is outside, inside and open. `predicted`: the point of the shape next to it, xi, has been evaluated. `bound`: how
// far points of the interval may be from where they are predicted, at most `step` away.
core_ray_clip core_clip_interval(const core_ray_evaluation here, elvis_real curvature, elvis_real step, elvis_real bound,
                                 elvis_vec3 predicted, elvis_vec3 xi, const core_segment segment) {
    // Far from a curved element the bound says nothing; there, two predictions that agree do, as in element/newton.glsl.
    const elvis_real along = core_max_norm(here.model.slope) * (segment.end - segment.begin);
    const elvis_real agreed = elvis_real(8) * core_max_norm(here.model.at - predicted) + segment.curvature * along * along;
    const elvis_real distance = sqrt(bound / max(curvature, elvis_real(1e-30LF)));
    const bool is_agreed = xi != predicted && !segment.is_inside && segment.iterations > 1u;
    core_ray_clip clip =
        core_clip_ray(here.model, is_agreed ? min(bound, agreed) : bound, core_slope_change(here.model, curvature, distance),
                      segment.is_inside, segment.is_followed || !segment.is_assumed, segment.entry, segment.begin, segment.end);
    // Where nothing is known, anything is possible.
    clip.possible_from = here.is_sound ? clip.possible_from : segment.begin;
    clip.possible_to = here.is_sound ? clip.possible_to : segment.end;
    clip.is_sure = here.is_sound && core_is_near(curvature, step) && clip.sure_from <= clip.sure_to;
    return clip;
}

// Uses this evaluation for the next prediction, unless its point may belong to another solution. The interval is no longer than it can be
// followed.
void core_predict_from(const core_ray_evaluation here, elvis_real curvature, elvis_real tolerance, inout core_segment segment) {
    const core_ray_model model = here.model;
    const bool is_anchor = here.is_sound && (!segment.is_followed || core_is_near(curvature, core_max_norm(model.newton_step)));
    const core_ray_point point = core_ray_point_at(model.anchor, model.at, model.slope);
    segment.before = core_either(is_anchor, core_either(segment.newton_step < CORE_NO_STEP, segment.anchor, point), segment.before);
    segment.anchor = core_either(is_anchor, point, segment.anchor);
    segment.newton_step = is_anchor ? core_model_step(model, model.anchor) : segment.newton_step;
    segment.noise = is_anchor ? model.noise : segment.noise;
    segment.anchor_curvature = is_anchor ? curvature : segment.anchor_curvature;
    const elvis_real rate = core_max_norm(core_slope_of(segment.anchor));
    const elvis_real follow_end =
        max(min(segment.anchor.t + core_follow_span(segment.anchor_curvature) / rate,
                segment.begin + core_sure_span(segment.anchor_curvature) / rate), segment.begin + tolerance);
    const bool is_too_far = segment.is_followed && follow_end < segment.end;
    segment.end = is_too_far ? follow_end : segment.end;
    segment.next = is_too_far ? elvis_real(0.5LF) * (segment.begin + segment.end) : segment.next;
}

// Where the next point is: no farther from the line along the last one's slope than the ray may be.
elvis_vec3 core_predicted_next(const core_segment segment) {
    const elvis_vec3 line = core_predicted(segment.anchor, segment.next);
#if !CORE_REMEMBERS_ENTRY
    return line;
#endif
    const elvis_vec3 cubic = core_predicted_by_two(segment.anchor, segment.before, segment.next);
    const elvis_real distance = abs(segment.next - segment.anchor.t) * core_max_norm(core_slope_of(segment.anchor));
    return core_max_norm(cubic - line) <= segment.anchor_curvature * distance * distance ? cubic : line;
}

// A point before the last one: where the ray has been found to enter, or the last one.
core_ray_point core_point_before(const core_segment segment) {
    return core_either(CORE_REMEMBERS_ENTRY == 1 && segment.entry_step < CORE_NO_STEP, segment.entry.point, segment.anchor);
}

// One iteration. CORE_SEGMENT_FOUND: from segment.enter to segment.leave. `element`: segment.element, known before the loop around this.
uint core_segment_iterate(core_traced_ray ray, uint element, inout core_segment segment) {
    const elvis_vec3 predicted = core_predicted_next(segment);
    elvis_real x = predicted.x, y = predicted.y, z = predicted.z;
    core_project(x, y, z);
    const elvis_vec3 xi = elvis_vec3(x, y, z);
    core_ray_evaluation here = core_evaluate_ray(ray, element, xi, segment.next);
    segment.iterations += 1u;
    const elvis_real curvature = core_assumed_curvature(core_segment_curvature(element, here.frame, segment), segment.iterations);
    segment.is_estimated = segment.is_estimated || segment.iterations > CORE_CERTAIN_ITERATIONS * CORE_ITERATIONS_SHARE;
    const elvis_real step = max(core_model_step(here.model, segment.begin), core_model_step(here.model, segment.end));
    const elvis_real bound = core_prediction_error(curvature, step);
#if ELVIS_HAS_INSIDE
    core_evaluate_inside(here.model, element, xi, step + bound);
#endif
    const core_ray_clip clip = core_clip_interval(here, curvature, step, bound, predicted, xi, segment);

    const bool was_inside = segment.is_inside;
    const int face = was_inside ? clip.to_face : clip.from_face;
    const elvis_real crossing = was_inside ? clip.to : clip.from;
    const core_root_error error = core_root_error_at(here.model, here.frame, curvature, face, crossing);
    bool is_exact = here.is_sound && face >= 0 && core_is_near(curvature, core_model_step(here.model, crossing)) &&
                    error.distance <= ray.tolerance * ray.speed;
#if ELVIS_HAS_INSIDE
    // The error is that of one face. Flat ones are known equally well; of the other one, more must be known.
    const bool own_holds = was_inside ? clip.own_holds_to : clip.own_holds_from;
    is_exact = is_exact && (face == CORE_INSIDE_FACE || !own_holds);
    // No more is wanted of its place than rounding leaves.
    ray.tolerance = own_holds ? max(ray.tolerance, min(core_own_blur(here.model), CORE_MOST_BLUR * ray.tolerance)) : ray.tolerance;
#endif
    const bool is_denied = segment.is_assumed && clip.possible_from > min(clip.possible_to, segment.begin + ray.tolerance);
    const bool is_confirmed = clip.is_sure && clip.sure_from <= segment.begin + ray.tolerance;
    const bool is_kept_in = was_inside && !is_denied;
    segment.is_assumed = segment.is_assumed && is_kept_in && !is_confirmed;
    bool has_left = false;
    if (is_kept_in) {
        has_left = core_seek_leave(ray, clip, is_exact, error.parameter, segment);
    }
    if (!is_kept_in) {
        // Where the own boundary lies, predictions of the mapping do not tell.
        const bool is_blurred = ELVIS_HAS_INSIDE == 0 && here.is_sound && !clip.is_sure &&
                                bound <= CORE_PREDICTION_SHARE * core_max_norm(here.model.noise);
        core_seek_enter(ray, clip, is_exact, is_blurred, error.parameter, segment);
    }
    segment.is_estimated = segment.is_estimated || (is_denied && core_is_assumed(segment));
    segment.is_followed = segment.is_followed && !is_denied;
    const bool is_at_crossing = is_kept_in && face >= 0 && segment.next == clamp(crossing, segment.begin, segment.end);
    core_predict_from(here, curvature, ray.tolerance, segment);
#if CORE_REMEMBERS_ENTRY
    const elvis_vec4 side = core_side_constraint(here.model, max(face, 0));
    const elvis_real refined = is_at_crossing ? core_crossing_by_two(segment.anchor, segment.before, side, crossing) : segment.next;
    segment.next = is_at_crossing ? clamp(refined, segment.begin, segment.end) : segment.next;
#endif

    const bool is_given_up = segment.iterations >= CORE_SEGMENT_ITERATIONS * CORE_ITERATIONS_SHARE;
    const bool is_found = is_kept_in && (has_left || is_given_up);
    segment.has_failed = is_given_up && !has_left;
    const bool is_last = !is_kept_in && !segment.is_inside && (segment.begin >= segment.last || is_given_up);
    segment.resume = is_given_up && !has_left ? segment.last : segment.resume;
    return is_found ? CORE_SEGMENT_FOUND : is_last ? CORE_SEGMENT_NONE : CORE_SEGMENT_OPEN;
}
