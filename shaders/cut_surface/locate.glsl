// Which element of a class holds a point of a cut surface.
//
// Every element within rounding of the point is a candidate: neighbours share a face in exact arithmetic only, and must leave no
// gap. Among candidates the viewer's side decides (key 0: a small step towards the viewer stays in the element), then the lowest
// number. So a plane that lies in element faces shows the elements in front of it, and all candidates have to be looked at. An element
// that holds the point by more than rounding goes before all of these, and is the only one of a valid mesh: there the search ends. Of a
// mesh in which elements may overlap (CORE_OVERLAPS) it goes on, and counts the elements that hold the point; where it is one, the answer
// is the same.
//
// Pixels are visited column by column, and the next one usually lies in the same element, a small step away: it is tried first,
// from the solution here carried on with the Jacobian here, which leaves one Newton step to do.
//
// The kernel brings core_entry(i), the nodes to descend from, picture/show.glsl, and the buffer core_elements
// (element/linearization.glsl).
//
// One loop serves all candidates of a pixel, one Newton step an iteration: lanes that dismiss a candidate after one step go on to their
// next one while others still iterate.

#include "cut_surface/element_candidate.glsl"

#ifdef elvis_fetch4_core_reaches
// Elements whose reaches are wanted (cut_surface/reach.glsl): whether there are any, then a word for each element.
layout(set = 0, binding = CORE_WANTED_REACHES_BINDING, std430) buffer core_wanted_reaches_block {
    uint core_wants_reaches;
    uint core_wants_reach_of[];
};
#endif

// Iterations of one pixel. A driver ends loops silently after 65535 iterations of an invocation, with those inside the snippet; this is
// far above what any sensible search takes and leaves room for a tile's other pixels.
#define CORE_WORK_LIMIT 2000u

// Where the column's last pixel was found, to carry on from. Its vectors change by selection only (shaders/README.md, loops).
struct core_track {
    // Local element, or CORE_NO_ELEMENT.
    uint element;
    elvis_real x, y, z;
    // Target of that pixel, in the snippet's coordinates, and J^-1 there.
    elvis_vec3 target;
    elvis_vec3 row0, row1, row2;
    elvis_real curvature;
};

core_track core_no_track() {
    core_track track;
    track.element = CORE_NO_ELEMENT;
    track.x = track.y = track.z = track.curvature = elvis_real(0);
    track.target = track.row0 = track.row1 = track.row2 = elvis_vec3(0);
    return track;
}

// First the element that held the column's last pixel.
core_element_candidate core_tracked_candidate(core_cut_point point, bool is_wanted, core_track track) {
    core_element_candidate candidate;
    candidate.element = is_wanted ? track.element : CORE_NO_ELEMENT;
    candidate.is_tracked = candidate.element != CORE_NO_ELEMENT;
    candidate.target = core_target_in(candidate.is_tracked ? candidate.element : 0u, point);
    const elvis_vec3 motion = elvis_vec3(candidate.target.x, candidate.target.y, candidate.target.z) - track.target;
    const elvis_vec3 step = elvis_vec3(dot(track.row0, motion), dot(track.row1, motion), dot(track.row2, motion));
    candidate.state = core_newton_begin(track.x + step.x, track.y + step.y, track.z + step.z,
                                        max(max(abs(step.x), abs(step.y)), abs(step.z)), track.curvature);
    return candidate;
}

// What is left of the list, and nodes that wait.
struct core_descent {
    uint n_entries, entry, stack_size;
    // Found to hold the point by carrying on from the last pixel: not to be looked at again.
    uint passed_over;
};
uint core_stack[CORE_STACK_SIZE];

bool core_has_more(core_descent descent) { return descent.stack_size > 0u || descent.entry < descent.n_entries; }

// To the next node: a candidate if it is an element that the point is not certain to lie outside of.
void core_next_element(core_cut_point point, vec3 in_hierarchy, float box_tolerance, inout core_descent descent,
                       inout core_element_candidate candidate) {
    const bool is_popped = descent.stack_size > 0u;
    const uint index = is_popped ? core_stack[descent.stack_size - 1u] : core_entry(descent.entry);
    descent.stack_size -= is_popped ? 1u : 0u;
    descent.entry += is_popped ? 0u : 1u;
    const core_node node = core_fetch_node(index);
    const bool is_touched = core_contains(node, in_hierarchy, box_tolerance) && core_may_hold(node);
    if (is_touched && node.is_leaf && node.child != descent.passed_over) {
        candidate.target = core_target_in(node.child, point);
        candidate.state =
            core_newton_start(node.child, elvis_vec3(candidate.target.x, candidate.target.y, candidate.target.z));
        candidate.element = core_is_outside(node.child, candidate.state) ? CORE_NO_ELEMENT : node.child;
    }
    // Entries are leaves as a rule.
    if (is_touched && !node.is_leaf) {
        core_stack[descent.stack_size] = node.child + 1u;
        core_stack[descent.stack_size + 1u] = node.child;
        descent.stack_size += 2u;
    }
}

// `is_kept`: the candidate holds the point by more than rounding, and is what is shown.
void core_keep_track(bool is_kept, core_element_candidate candidate, core_inverse inverse, inout core_track track) {
    track.element = is_kept ? candidate.element : track.element;
    track.x = is_kept ? candidate.state.x : track.x;
    track.y = is_kept ? candidate.state.y : track.y;
    track.z = is_kept ? candidate.state.z : track.z;
    track.target = is_kept ? elvis_vec3(candidate.target.x, candidate.target.y, candidate.target.z) : track.target;
    track.curvature = is_kept ? candidate.state.curvature : track.curvature;
    track.row0 = is_kept ? inverse.row0 : track.row0;
    track.row1 = is_kept ? inverse.row1 : track.row1;
    track.row2 = is_kept ? inverse.row2 : track.row2;
}

// A step of Newton's method in the candidate.
void core_step_in_candidate(core_cut_point point, inout core_element_candidate candidate, inout core_descent descent,
                            inout core_location found, inout core_track track) {
    const bool is_active = candidate.element != CORE_NO_ELEMENT;
    const uint element = is_active ? candidate.element : 0u;
    core_inverse inverse;
    const uint ending = core_newton_step(element, elvis_vec3(candidate.target.x, candidate.target.y, candidate.target.z),
                                         candidate.target.error, candidate.state, inverse);
    const uint status = is_active ? ending : CORE_NEWTON_OUTSIDE;
    found.n_steps += is_active ? 1u : 0u;
    // A failure from the last pixel's solution is none: the search tries the element again from its own start.
    found.n_failures += status == CORE_NEWTON_FAILED && !candidate.is_tracked ? 1u : 0u;
    const elvis_real excess = core_excess(candidate.state.x, candidate.state.y, candidate.state.z);
    // No constraint sums more than the three coordinates. 2: the point's error and the solution's.
    const elvis_real most = elvis_real(2) * (inverse.error0 + inverse.error1 + inverse.error2);
    const core_side side =
        core_judge_candidate(element, candidate, inverse, point.direction, status == CORE_NEWTON_CONVERGED, excess, most);
    const bool is_held = side.is_inside && excess < -most && (ELVIS_HAS_INSIDE == 0 || !side.is_on_face);
    // In no other element of a valid mesh.
    const bool is_alone = is_held && CORE_OVERLAPS == 0;
    const bool is_dismissed = status == CORE_NEWTON_OUTSIDE || status == CORE_NEWTON_FAILED ||
                              (status == CORE_NEWTON_CONVERGED && excess > most);
    const bool is_open = is_active && !candidate.is_tracked && is_dismissed && !candidate.state.is_certain;
    found.n_open += is_open ? 1u : 0u;
    // The two first ones, in whatever order they are met.
    found.other_open_element =
        is_open ? min(found.other_open_element, max(found.open_element, candidate.element)) : found.other_open_element;
    found.open_element = is_open ? min(found.open_element, candidate.element) : found.open_element;
    const bool is_accepted = side.is_inside && (is_held || (!candidate.is_tracked && found.n_holders == 0u));
    core_forget_candidates(is_held && found.n_holders == 0u, found);
    found.n_holders += is_held ? 1u : 0u;
    core_take_candidate(is_accepted, candidate, elvis_fetch_core_elements(element, 0u), side, found);
    const bool is_done = status != CORE_NEWTON_RUNNING;
    core_keep_track(is_held && found.element == candidate.element, candidate, inverse, track);
    descent.passed_over = is_held && candidate.is_tracked ? candidate.element : descent.passed_over;
    candidate.is_tracked = candidate.is_tracked && !is_done;
    candidate.element = is_done ? CORE_NO_ELEMENT : candidate.element;
    descent.entry = is_alone ? descent.n_entries : descent.entry;
    descent.stack_size = is_alone ? 0u : descent.stack_size;
}

core_location core_locate(core_cut_point point, uint n_entries, inout core_track track) {
    const vec3 in_hierarchy = vec3(point.position + core_reference_in_hierarchy.xyz);
    const float box_tolerance = core_box_tolerance(point, in_hierarchy);
    core_location found = core_nothing_found();
    core_descent descent = core_descent(n_entries, 0u, 0u, CORE_NO_ELEMENT);
    core_element_candidate candidate = core_tracked_candidate(point, n_entries > 0u, track);
    track.element = n_entries > 0u ? CORE_NO_ELEMENT : track.element;
    uint work = 0u;
    while ((candidate.element != CORE_NO_ELEMENT || core_has_more(descent)) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (candidate.element == CORE_NO_ELEMENT && core_has_more(descent)) {
            core_next_element(point, in_hierarchy, box_tolerance, descent, candidate);
            if (candidate.element != CORE_NO_ELEMENT || !core_has_more(descent)) {
                break;
            }
        }
        core_step_in_candidate(point, candidate, descent, found, track);
        if (candidate.element == CORE_NO_ELEMENT && !core_has_more(descent)) {
            break;
        }
    }
    found.is_cut_short = candidate.element != CORE_NO_ELEMENT || core_has_more(descent);
    // Failures are of no account if the point lies inside of an element; if none holds it, the pixel is open.
    const bool is_on_face = found.element != CORE_NO_ELEMENT && found.is_on_face;
    found.n_failures = is_on_face ? found.n_failures : 0u;
    // Only two are compared (cut_surface/other_values.comp).
    found.is_ambiguous = found.is_ambiguous || (core_lists_others != 0u && found.n_candidates > 2u);
    return found;
}

// One of the elements that share the point but are not shown.
void core_list_other(uint pixel, core_location found) {
    if (core_lists_others != 0u && found.n_candidates > 1u) {
        core_others[atomicAdd(core_n_others, 1u)] =
            core_other_element(found.other_x, found.other_y, found.other_z, found.other, pixel);
    }
}

// Some elements were dismissed without a bound, or given up. If none was found the point is open.
void core_list_open_point(uint pixel, core_location found) {
#ifdef elvis_fetch4_core_reaches
    if (found.n_open > 0u && core_wants_reach_of[found.open_element] == 0u) {
        core_wants_reach_of[found.open_element] = 1u;
        core_wants_reaches = 1u;
    }
#endif
    if (found.n_open > 0u && found.element == CORE_NO_ELEMENT) {
        core_open_points[atomicAdd(core_n_open_points, 1u)] =
            core_open_point(pixel, found.n_open <= 2u ? found.open_element : CORE_NO_ELEMENT, found.other_open_element);
    }
}
