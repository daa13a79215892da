// Where a point lies in the octants of elements that wait on a stack (cut_surface/octant_roots.glsl).
//
// An octant whose linear model says that it does not hold the point costs no evaluation. In the others Newton's method
// starts from that model. It ends with a solution; or with a prediction that lies farther outside of the octant, or of the element, than
// the octant's curvature lets it be off. Otherwise the octant's eighths are looked at, in which a prediction can be off less.

#include "isosurface/octant_parts.glsl"
#include "cut_surface/octant_descent.glsl"

// Parts of octants have codes, too. Where an octant is bent more than this there is no use in them.
#define CORE_MOST_DIVIDED_BEND elvis_real(2)
// Of Newton's method in an octant.
#define CORE_OCTANT_STEPS 8u

struct core_octant_candidate {
    core_element_candidate in_element;
    uint code;
};

// A search in an octant, or in a part of it. `y`: local coordinates that it starts from.
core_octant_candidate core_candidate_in(uint element, uint code, elvis_real curvature, vec3 y, core_cut_point point) {
    const vec3 start = core_octant_middle(code) + core_octant_half_side(code) * clamp(y, -1.0, 1.0);
    core_octant_candidate candidate;
    candidate.in_element.element = element;
    candidate.in_element.is_tracked = false;
    candidate.in_element.target = core_target_in(element, point);
    candidate.in_element.state =
        core_newton_begin(elvis_real(start.x), elvis_real(start.y), elvis_real(start.z), elvis_real(-1), curvature);
    candidate.code = code;
    return candidate;
}

// A part of an octant is a candidate; so is an octant if its linear model does not say that it lacks the point.
void core_take_octant(uint word, core_cut_point point, vec3 in_hierarchy, const core_octant_search search,
                      inout core_octant_candidate candidate) {
    const bool is_part = (word & CORE_OCTANT_PART) != 0u;
    const core_octant octant = core_fetch_octant(is_part ? 0u : word);
    const core_octant_guess guess = core_guess_in(octant, point, in_hierarchy);
    if (is_part || guess.may_hold) {
        candidate = core_candidate_in(is_part ? search.element : octant.element, is_part ? word & ~CORE_OCTANT_PART : octant.code,
                                      is_part ? search.curvature : elvis_real(octant.curvature), is_part ? vec3(0) : guess.y, point);
    }
}

// The eighths of an octant that share more than an edge with the shape.
void core_divide_octant(uint element, uint code, elvis_real curvature, inout core_octant_search search) {
    search.element = element;
    search.curvature = curvature;
    for (uint eighth = 0u; eighth < 8u; ++eighth) {
        const uint part = core_octant_part(code, eighth);
        core_stack[search.stack_size] = part | CORE_OCTANT_PART;
        search.stack_size += core_is_in_shape(part) ? 1u : 0u;
    }
}

// Into the octant, so that its curvature holds on the way. Returns how far from there a point of the octant can be.
elvis_real core_enter_octant(uint code, inout core_newton state) {
    const elvis_vec3 middle = elvis_vec3(core_octant_middle(code));
    const elvis_real half_side = elvis_real(core_octant_half_side(code));
    state.x = clamp(state.x, middle.x - half_side, middle.x + half_side);
    state.y = clamp(state.y, middle.y - half_side, middle.y + half_side);
    state.z = clamp(state.z, middle.z - half_side, middle.z + half_side);
    return half_side + core_max_norm(core_projected(elvis_vec3(state.x, state.y, state.z)) - middle);
}

// Whether the last prediction lies farther outside of the octant or the element than it can be off.
bool core_is_beyond_octant(uint code, core_newton state, core_inverse inverse, elvis_real farthest) {
    const elvis_vec3 way = elvis_vec3(state.x, state.y, state.z) - elvis_vec3(core_octant_middle(code));
    const elvis_real rounding = elvis_real(2) * max(max(inverse.error0, inverse.error1), inverse.error2);
    const elvis_real error = rounding + core_prediction_error_within(state.curvature, state.last_step, farthest);
    return core_max_norm(way) > elvis_real(core_octant_half_side(code)) + error ||
           core_excess(state.x, state.y, state.z) > CORE_CONSTRAINT_NORM * error;
}

// A step of Newton's method in the candidate.
void core_step_in_octant(core_cut_point point, inout core_octant_candidate candidate, inout core_octant_search search,
                         inout core_location found) {
    core_element_candidate there = candidate.in_element;
    const bool is_active = there.element != CORE_NO_ELEMENT;
    const uint element = is_active ? there.element : 0u;
    const elvis_real farthest = core_enter_octant(candidate.code, there.state);
    core_inverse inverse;
    const uint status = core_newton_step(element, elvis_vec3(there.target.x, there.target.y, there.target.z), there.target.error,
                                         there.state, inverse);
    const bool has_converged = is_active && status == CORE_NEWTON_CONVERGED;
    const bool is_first_start = there.state.start == 0u;
    const elvis_real excess = core_excess(there.state.x, there.state.y, there.state.z);
    const elvis_real most = elvis_real(2) * (inverse.error0 + inverse.error1 + inverse.error2);
    const core_side side = core_judge_candidate(element, there, inverse, point.direction, has_converged, excess, most);
    // Neighbouring octants share points of an element.
    core_take_candidate(side.is_inside && there.element != found.element && there.element != found.other, there,
                        elvis_fetch_core_elements(element, 0u), side, found);
    const bool is_elsewhere = is_first_start && core_is_beyond_octant(candidate.code, there.state, inverse, farthest);
    const bool is_decided = (has_converged && excess <= most) || is_elsewhere;
    const bool is_at_end = has_converged || !is_first_start || there.state.steps >= CORE_OCTANT_STEPS;
    if (is_active && is_at_end && !is_decided) {
        const elvis_real bend = there.state.curvature * elvis_real(core_octant_half_side(candidate.code));
        const bool is_divided = (candidate.code & 7u) < CORE_MOST_LEVELS && bend < CORE_MOST_DIVIDED_BEND;
        if (is_divided) {
            core_divide_octant(element, candidate.code, there.state.curvature, search);
        }
        search.is_undecided = search.is_undecided || !is_divided;
    }
    there.element = is_decided || is_at_end ? CORE_NO_ELEMENT : there.element;
    candidate.in_element = there;
    found.n_steps += is_active ? 1u : 0u;
}

// In the octants that wait on the stack.
core_location core_locate_in_octants(core_cut_point point, vec3 in_hierarchy, float box_tolerance, inout core_octant_search search) {
    core_location found = core_nothing_found();
    core_octant_candidate candidate = core_candidate_in(0u, 0u, elvis_real(0), vec3(0), point);
    candidate.in_element.element = CORE_NO_ELEMENT;
    while ((candidate.in_element.element != CORE_NO_ELEMENT || search.stack_size > 0u) && search.work < CORE_WORK_LIMIT) {
        while (candidate.in_element.element == CORE_NO_ELEMENT && search.stack_size > 0u) {
            const uint octant = core_next_octant(in_hierarchy, box_tolerance, search);
            if (octant != CORE_NO_OCTANT) {
                core_take_octant(octant, point, in_hierarchy, search, candidate);
            }
            if (candidate.in_element.element != CORE_NO_ELEMENT || search.stack_size == 0u || search.work >= CORE_WORK_LIMIT) {
                break;
            }
        }
        // Most points lie in no octant: they cost no evaluation.
        if (candidate.in_element.element == CORE_NO_ELEMENT) {
            break;
        }
        search.work += 1u;
        core_step_in_octant(point, candidate, search, found);
    }
    found.is_cut_short = search.is_cut_short || candidate.in_element.element != CORE_NO_ELEMENT || search.stack_size > 0u;
    found.is_ambiguous = found.is_ambiguous || (core_lists_others != 0u && found.n_candidates > 1u);
    return found;
}
