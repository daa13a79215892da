// From element to element through shared faces (segments/walk_state.glsl):
//
//     walk = core_walk_begin(state.walk, ...)
//     while (core_walk_goes_here(walk)) {
//         while (core_walk_goes_here(walk)) {
//             core_passage passage = core_walk_pass(ray, walk, segment): the ray is in the element from walk.at to passage.leave;
//             what is done already, up to walk.done, does not count
//             core_walk_go_on(ray, segment.leave_face, passage, from, walk): to the next element
//             if (subgroupAny(core_walk_needs_help(walk))) break;
//         }
//         core_walk_help(ray, walk, segment)
//     }
//     state.walk = core_walk_end(walk)
//
// Few rays need help. All lanes go through its code where it stands, so that it stands outside of the inner loop, which all lanes leave
// when one needs it.
//
// The kernel brings segments/segment.glsl; arithmetic/driver_limit.glsl; core_links; core_first_element and core_n_elements, the class's
// among all elements of the volume, which links are of; core_extent, the diagonal of the volume's bounds; core_zero.

#ifndef CORE_WALK_WALK
#define CORE_WALK_WALK

#include "segments/walk_state.glsl"

// After this many very short segments in a row, the walk searches for the element around the ray.
#define CORE_MOST_GRAZES 4u
// Over the volume's size: gaps between elements of a walk that are rounding's.
#define CORE_WIDEST_GAP 1e-6

// Elements looked at for the one that holds a point of the ray, when rounding has led it past an edge.
#define CORE_MOST_HOPS 16u
// Of rays along faces: steps towards where they leave; violation of the face within which they run along it.
#define CORE_ROUGH_ITERATIONS 8u
#define CORE_ALONG 1e-5

bool core_is_of_class(uint global_element) {
    return global_element >= core_first_element && global_element - core_first_element < core_n_elements;
}

// Goes from element to element towards the point of the ray at t, until one holds it.
struct core_around {
    bool is_open;
    uint element;
    elvis_real t, x, y, z;
    uint hops, steps;
    bool is_found, has_left;
    // The global element of another class in which to go on, where it has left this one; CORE_NO_LINK if there is none.
    uint other;
};

core_around core_around_begin(bool is_wanted, uint element, elvis_real t) {
    return core_around(is_wanted, element, t, CORE_CENTROID.x, CORE_CENTROID.y, CORE_CENTROID.z, 0u, 0u, false, false, CORE_NO_LINK);
}

// `here`: at the search's point.
void core_around_step(const core_ray_evaluation here, inout core_around around) {
    const elvis_vec3 next =
        elvis_vec3(around.x, around.y, around.z) + clamp(here.model.newton_step, elvis_vec3(-4), elvis_vec3(4));
    const elvis_real noise = elvis_real(4) * core_max_norm(here.model.noise);
    around.steps += 1u;
    const bool is_there = core_max_norm(here.model.newton_step) <= noise || around.steps >= 8u;
    elvis_real worst = elvis_real(-4);
    uint worst_face = 0u;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_real excess = dot(constraint.xyz, next) + constraint.w;
        worst_face = excess > worst ? uint(face) : worst_face;
        worst = max(worst, excess);
    }
    around.is_found = is_there && worst <= noise;
    const bool leaves = is_there && !around.is_found;
    const uint link = elvis_fetch_core_links(around.element, worst_face);
    const bool is_of_class = core_is_of_class(link);
    around.hops += leaves ? 1u : 0u;
    around.has_left = leaves && !is_of_class;
    around.other = around.has_left ? link : around.other;
    around.is_open = !around.is_found && !around.has_left && around.hops < CORE_MOST_HOPS && here.frame.is_sound;
    around.element = leaves && is_of_class ? link - core_first_element : around.element;
    around.steps = leaves ? 0u : around.steps;
    elvis_real x = next.x, y = next.y, z = next.z;
    core_project(x, y, z);
    around.x = leaves ? CORE_CENTROID.x : x;
    around.y = leaves ? CORE_CENTROID.y : y;
    around.z = leaves ? CORE_CENTROID.z : z;
}

// Whether it has found an element that holds the point.
bool core_around_is_held(const core_around around) {
#if ELVIS_HAS_INSIDE
    // Beyond the element's own boundary no neighbour is known.
    return around.is_found && core_is_within(around.element, elvis_vec3(around.x, around.y, around.z), elvis_vec3(CORE_ALONG));
#else
    return around.is_found;
#endif
}

// Where the ray leaves the element as Newton's method predicts it, without bounds: for rays that run along a curved face within
// rounding. That face does not count. The segment is an estimate.
struct core_rough {
    bool is_open;
    uint iterations;
    elvis_real from, leave;
    int leave_face;
};

// `model`: of the ray at where it is to leave.
void core_rough_step(const core_traced_ray ray, const core_ray_model model, inout core_rough rough, inout core_segment segment) {
    elvis_real first = rough.from + ray.longest;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_real value = dot(constraint.xyz, model.at) + constraint.w, rate = dot(constraint.xyz, model.slope);
        const elvis_real root = rough.leave - value / rate;
        const bool is_along = abs(value) + abs(value + (rough.from - rough.leave) * rate) <= elvis_real(CORE_ALONG);
        const bool is_first = rate > elvis_real(0) && !is_along && root > rough.from && root < first;
        rough.leave_face = is_first ? face : rough.leave_face;
        first = is_first ? root : first;
    }
    segment.anchor = core_ray_point_at(rough.leave, model.at, model.slope);
    rough.leave = first;
    rough.iterations += 1u;
    rough.is_open = rough.iterations < CORE_ROUGH_ITERATIONS;
}

bool core_walk_goes_here(core_walk walk) { return walk.status == CORE_RAY_GOES && core_is_of_class(walk.global_element); }

// Of a ray that ends at `to` and then has the status `status_at_end`. `is_ray`: false for lanes without a ray.
core_walk core_walk_begin(core_walk_state state, bool is_ray, elvis_real to, uint status_at_end) {
    const uint status = is_ray ? state.status : CORE_RAY_ENDS;
    const bool has_sought = status == CORE_RAY_HAS_SOUGHT, is_without = has_sought && state.global_element == CORE_NO_ELEMENT;
    const bool is_mine = is_without || ((has_sought || status == CORE_RAY_GOES) && core_is_of_class(state.global_element));
    const bool begins = is_mine && has_sought && !is_without;
    return core_walk(state.done, state.at, begins ? state.at : state.start,
                     begins ? state.global_element : state.global_start_element, state.global_element,
                     is_without ? CORE_RAY_ENDS : is_mine && state.at >= to ? status_at_end : begins ? CORE_RAY_GOES : status,
                     state.flags, is_mine, 0u, false, false, false, false);
}

core_walk_state core_walk_end(core_walk walk) {
    const bool is_cut_short = core_has_driver_given_up(core_zero), seeks = walk.status == CORE_RAY_SEEKS;
    return core_walk_state(walk.done, seeks ? CORE_FAR : walk.at, walk.start, walk.global_start_element,
                           seeks ? CORE_NO_ELEMENT : walk.global_element,
                           is_cut_short ? CORE_RAY_ENDS : walk.status, walk.flags | (is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u));
}

// A ray in the element that the walk is in (walk.global_element).
struct core_passage {
    bool is_met;
    // Where it leaves; walk.at if the element is not met.
    elvis_real leave;
};

core_passage core_walk_pass(const core_traced_ray ray, inout core_walk walk, inout core_segment segment) {
    uint ending = CORE_SEGMENT_FOUND;
    if (!walk.has_segment) {
        const bool is_possible =
            core_segment_begin(ray, walk.global_element - core_first_element, walk.at, walk.at + ray.longest, true, segment);
        ending = is_possible ? CORE_SEGMENT_OPEN : CORE_SEGMENT_NONE;
    }
#if CORE_HAS_CURVED
    if (!walk.has_segment && segment.curvature > CORE_FOLLOWED_CURVATURE) {
        const bool is_entered = core_segment_enter(ray, elvis_real(CORE_WIDEST_GAP * core_extent) / ray.speed, segment);
        ending = is_entered ? CORE_SEGMENT_OPEN : ending;
    }
#endif
    const uint element = segment.element;
    while (ending == CORE_SEGMENT_OPEN) {
        ending = core_segment_iterate(ray, element, segment);
        if (ending != CORE_SEGMENT_OPEN) {
            break;
        }
    }
    walk.needs_roughly = segment.has_failed && !walk.has_segment;
    walk.has_segment = false;
    core_passage passage;
    // Where a ray grazes a face, elements on both sides find it at points farther apart than those of others.
    const elvis_real gap = segment.enter - walk.at - segment.enter_error;
    passage.is_met = ending == CORE_SEGMENT_FOUND && !walk.needs_roughly && gap <= elvis_real(CORE_WIDEST_GAP * core_extent) / ray.speed;
    walk.flags |= passage.is_met && segment.is_estimated ? CORE_FLAG_ESTIMATED : 0u;
    passage.leave = passage.is_met ? max(segment.leave, walk.at) : walk.at;
    return passage;
}

// To the next element, where the ray has left this one. `from`: where its segment in this one begins.
void core_walk_go_on(const core_traced_ray ray, int leave_face, core_passage passage, elvis_real from, inout core_walk walk) {
    bool stays = walk.needs_roughly;
    walk.is_ahead = walk.is_ahead && stays;
    walk.at = stays ? walk.at : passage.leave;
    const uint next = elvis_fetch_core_links(walk.global_element - core_first_element, uint(max(leave_face, 0)));
    // Elements on both sides of a face that the ray grazes may hand it to and fro.
    const bool is_stuck = passage.leave - from <= elvis_real(4) * ray.tolerance;
    // The face did not tell, or rounding led past an edge.
    walk.needs_element = !stays && (!passage.is_met || leave_face < 0 || (is_stuck && walk.n_lost >= CORE_MOST_GRAZES));
    walk.n_lost = stays ? walk.n_lost : walk.needs_element || is_stuck ? walk.n_lost + 1u : 0u;
    stays = stays || walk.needs_element;
    walk.global_element = stays ? walk.global_element : next;
    walk.status = !stays && next == CORE_NO_LINK ? CORE_RAY_SEEKS : CORE_RAY_GOES;
}

bool core_walk_needs_help(core_walk walk) { return walk.needs_roughly || walk.needs_element; }

void core_walk_help(const core_traced_ray ray, inout core_walk walk, inout core_segment segment) {
    const elvis_real probe = walk.at + elvis_real(4) * exp2(float(min(walk.n_lost - 1u, 30u))) * ray.tolerance;
    core_around around = core_around_begin(walk.needs_element, walk.global_element - core_first_element, probe);
    core_rough rough = core_rough(walk.needs_roughly, 0u, walk.at, walk.at, CORE_NO_FACE);
    while (rough.is_open || around.is_open) {
        const elvis_vec3 predicted = core_predicted(segment.anchor, rough.leave);
        elvis_real x = predicted.x, y = predicted.y, z = predicted.z;
        core_project(x, y, z);
        const uint element = rough.is_open ? segment.element : around.element;
        const elvis_vec3 xi = rough.is_open ? elvis_vec3(x, y, z) : elvis_vec3(around.x, around.y, around.z);
        const core_ray_evaluation here = core_evaluate_ray(ray, element, xi, rough.is_open ? rough.leave : around.t);
        if (rough.is_open) {
            core_rough_step(ray, here.model, rough, segment);
        } else {
            core_around_step(here, around);
        }
        if (!(rough.is_open || around.is_open)) {
            break;
        }
    }
    if (walk.needs_roughly) {
        segment.enter = walk.at;
        segment.enter_error = elvis_real(0);
        segment.leave = rough.leave;
        segment.leave_face = rough.leave_face;
        segment.newton_step = elvis_real(3e38LF);
        segment.is_estimated = true;
        // Those of the search that failed have been counted.
        segment.iterations = 0u;
        walk.flags |= CORE_FLAG_UNDECIDED;
        walk.has_segment = true;
    }
    if (walk.needs_element) {
        walk.flags |= !around.is_found && !around.has_left ? CORE_FLAG_UNDECIDED : 0u;
        walk.global_element = core_around_is_held(around) ? core_first_element + around.element : around.other;
        walk.at = probe;
        walk.is_ahead = true;
        walk.status = walk.global_element == CORE_NO_LINK ? CORE_RAY_SEEKS : CORE_RAY_GOES;
    }
    walk.needs_roughly = walk.needs_element = false;
}

#endif
