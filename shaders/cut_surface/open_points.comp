// Points of a cut surface that may lie in an element which the search (cut_surface/locate.glsl) has dismissed without a bound: they are
// looked for in octants so small that the mapping in each is nearly linear.
//
// Octants (isosurface/octant.glsl) are made for an element when a point first asks for them: a hierarchy of boxes for each element, all in
// one buffer. An octant whose linear model says that it does not hold the point costs no evaluation. In the others Newton's method
// starts from that model. It ends with a solution; or with a prediction that lies farther outside of the octant, or of the element, than
// the octant's curvature lets it be off. Otherwise the octant's eighths are looked at, in which a prediction can be off less. What is left
// in the end makes the pixel undecided, unless the point is found elsewhere.
//
// An invocation is a pixel of the list.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "element/place.glsl"
#include "picture/samples.glsl"
#include "picture/view.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
// Of each element: the root of its octants, or one of the words below.
layout(set = 0, binding = 5, std430) buffer core_roots_block { uint core_roots[]; };
// Elements of which octants are wanted.
layout(set = 0, binding = 6, std430) buffer core_asked_block {
    uint core_n_asked;
    uint core_asked[];
};
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first;
    // Counted from 1; 0 is no surface.
    uint core_surface_number;
    uint core_first_component;
    uint core_end_component;
    // Elements that share a point may have other values there.
    uint core_lists_others;
    // Of values: what makes no difference to the picture.
    float core_value_tolerance;
    // core_hit_point
    float core_most_error;
    uint core_wants_places;
};

#define CORE_OPEN_POINTS_BINDING 4
#include "cut_surface/open_points.glsl"
#if !CORE_ON_PLANE
#include "cut_surface/hit_point.glsl"
layout(set = 0, binding = 7, std430) readonly buffer core_hits_block { core_hit_record core_hits[]; };
// Written if core_wants_places.
layout(set = 0, binding = 8, std430) writeonly buffer core_places_block { core_place core_places[]; };
#endif

#include "arithmetic/count.glsl"
#include "picture/show.glsl"
#include "cut_surface/element_candidate.glsl"
#include "isosurface/octant.glsl"

#define CORE_NO_OCTANTS 0xffffffffu
#define CORE_ASKED_FOR 0xfffffffeu
// There was no room for them.
#define CORE_NO_ROOM 0xfffffffdu
// What waits is a node of octants; a part of an octant, by its code; or a node of elements.
#define CORE_OCTANT_NODE 0x80000000u
#define CORE_OCTANT_PART 0x40000000u
// Parts of octants have codes, too. Where an octant is bent more than this there is no use in them.
#define CORE_MOST_LEVELS 6u
#define CORE_MOST_DIVIDED_BEND elvis_real(2)
// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 8000u
// Of Newton's method in an octant.
#define CORE_OCTANT_STEPS 8u

// Nodes of elements and of octants, and seven parts of an octant at each level.
uint core_stack[2 * CORE_STACK_SIZE + 8 * CORE_MOST_LEVELS];

core_node core_fetch_octant_node(uint index) {
    const uvec4 first = elvis_fetch4_core_octant_nodes(index, 0u);
    const uvec4 second = elvis_fetch4_core_octant_nodes(index, 1u);
    return core_node(uintBitsToFloat(first.xyz), uintBitsToFloat(second.xyz), first.w, second.w != 0u);
}

core_cut_point core_point_of(uint pixel) {
    const core_cut_column along = core_cut_begin(elvis_real(pixel % core_size.x));
    const elvis_real row = elvis_real(pixel / core_size.x);
#if CORE_ON_PLANE
    core_cut_point point = core_cut_pixel(along, row);
#else
    core_cut_point point = core_hit_point(along, row, core_hits[pixel], core_most_error);
#endif
    point.error += core_data_error();
    return point;
}

// Whether the pixel's point would be seen, and no other class has found it.
bool core_is_wanted(uint pixel, core_cut_point point) {
    const uint surface = core_marks[pixel].owner >> CORE_OWNER_BITS;
    const elvis_real depth = (point.t + core_reference.w) * length(point.direction);
    return surface == 0u || (surface != core_surface_number && depth < core_samples[pixel].depth);
}

struct core_octant_candidate {
    core_element_candidate in_element;
    uint code;
};

// What of the search is not in core_location.
struct core_octant_search {
    uint stack_size;
    bool has_asked, is_undecided;
    // Of the octant whose parts wait.
    uint element;
    elvis_real curvature;
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

// An octant is a candidate if its linear model does not say that it lacks the point.
void core_take_octant(uint index, core_cut_point point, vec3 in_hierarchy, inout core_octant_candidate candidate) {
    const core_octant octant = core_fetch_octant(index);
    const float far = max(max(abs(in_hierarchy.x), abs(in_hierarchy.y)), abs(in_hierarchy.z));
    const float tolerance = core_octant_tolerance(octant, far + float(point.error) / float(CORE_OCTANT_ROUNDING));
    const bool is_linear = octant.size > 0.0;
    const vec3 y = is_linear ? core_octant_rotate(octant, in_hierarchy - octant.middle) : vec3(0);
    if (max(max(abs(y.x), abs(y.y)), abs(y.z)) <= 1.0 + tolerance) {
        candidate = core_candidate_in(octant.element, octant.code, elvis_real(octant.curvature), y, point);
    }
}

// An element that the point is not certain to lie outside of: to its octants.
void core_descend_into_element(uint element, core_cut_point point, inout core_octant_search search) {
    const core_target target = core_target_in(element, point);
    const bool is_outside = core_is_outside(core_newton_start(element, elvis_vec3(target.x, target.y, target.z)));
    const uint root = is_outside ? CORE_NO_ROOM : core_roots[element];
    if (root == CORE_NO_OCTANTS && atomicCompSwap(core_roots[element], CORE_NO_OCTANTS, CORE_ASKED_FOR) == CORE_NO_OCTANTS) {
        core_asked[atomicAdd(core_n_asked, 1u)] = element;
    }
    search.has_asked = search.has_asked || root == CORE_NO_OCTANTS || root == CORE_ASKED_FOR;
    search.is_undecided = search.is_undecided || (root == CORE_NO_ROOM && !is_outside);
    if (root < CORE_NO_ROOM) {
        core_stack[search.stack_size] = root | CORE_OCTANT_NODE;
        search.stack_size += 1u;
    }
}

void core_next_octant(core_cut_point point, vec3 in_hierarchy, float box_tolerance, inout core_octant_search search,
                      inout core_octant_candidate candidate) {
    search.stack_size -= 1u;
    const uint word = core_stack[search.stack_size], kind = word & (CORE_OCTANT_NODE | CORE_OCTANT_PART), index = word & ~kind;
    if (kind == CORE_OCTANT_PART) {
        candidate = core_candidate_in(search.element, index, search.curvature, vec3(0), point);
        return;
    }
    core_node node;
    if (kind != 0u) {
        node = core_fetch_octant_node(index);
    } else {
        node = core_fetch_node(index);
    }
    const bool is_touched = core_contains(node, in_hierarchy, box_tolerance);
    if (is_touched && !node.is_leaf) {
        core_stack[search.stack_size] = (node.child + 1u) | kind;
        core_stack[search.stack_size + 1u] = node.child | kind;
        search.stack_size += 2u;
    }
    if (is_touched && node.is_leaf && kind != 0u) {
        core_take_octant(node.child, point, in_hierarchy, candidate);
    }
    if (is_touched && node.is_leaf && kind == 0u) {
        core_descend_into_element(node.child, point, search);
    }
}

// The eighths of an octant that share more than an edge with the shape.
void core_divide_octant(uint element, uint code, elvis_real curvature, inout core_octant_search search) {
    const uint mask = (1u << CORE_OCTANT_PLACE_BITS) - 1u;
    search.element = element;
    search.curvature = curvature;
    for (uint eighth = 0u; eighth < 8u; ++eighth) {
        uint part = (code & 7u) + 1u;
        for (uint axis = 0u; axis < 3u; ++axis) {
            const uint shift = 3u + axis * uint(CORE_OCTANT_PLACE_BITS);
            part |= (2u * ((code >> shift) & mask) + ((eighth >> axis) & 1u)) << shift;
        }
        // Near the corner that is deepest in the shape.
        const elvis_vec3 deepest = elvis_vec3(core_octant_middle(part) - 0.99 * core_octant_half_side(part));
        core_stack[search.stack_size] = part | CORE_OCTANT_PART;
        search.stack_size += core_excess(deepest.x, deepest.y, deepest.z) < elvis_real(0) ? 1u : 0u;
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

core_location core_locate_in_octants(core_cut_point point, bool is_wanted, inout core_octant_search search) {
    const vec3 in_hierarchy = vec3(point.position + core_reference_in_hierarchy.xyz);
    const float box_tolerance = core_box_tolerance(point, in_hierarchy);
    core_location found = core_nothing_found();
    core_octant_candidate candidate = core_candidate_in(0u, 0u, elvis_real(0), vec3(0), point);
    candidate.in_element.element = CORE_NO_ELEMENT;
    // The hierarchy's root.
    core_stack[0] = 0u;
    search = core_octant_search(is_wanted ? 1u : 0u, false, false, 0u, elvis_real(0));
    uint work = 0u;
    while ((candidate.in_element.element != CORE_NO_ELEMENT || search.stack_size > 0u) && work < CORE_WORK_LIMIT) {
        while (candidate.in_element.element == CORE_NO_ELEMENT && search.stack_size > 0u && work < CORE_WORK_LIMIT) {
            work += 1u;
            core_next_octant(point, in_hierarchy, box_tolerance, search, candidate);
        }
        // Most points lie in no octant: they cost no evaluation.
        if (candidate.in_element.element == CORE_NO_ELEMENT) {
            break;
        }
        work += 1u;
        core_step_in_octant(point, candidate, search, found);
    }
    found.is_cut_short = candidate.in_element.element != CORE_NO_ELEMENT || search.stack_size > 0u;
    found.is_ambiguous = core_lists_others != 0u && found.n_candidates > 1u;
    return found;
}

void main() {
    const uint i = core_first + gl_GlobalInvocationID.x;
    const bool is_listed = i < core_n_open_points;
    const uint pixel = core_open_points[is_listed ? i : core_first];
    const core_cut_point point = core_point_of(pixel);
    const bool is_wanted = is_listed && core_is_wanted(pixel, point);
    core_octant_search search;
    const core_location found = core_locate_in_octants(point, is_wanted, search);
    const bool has_found = found.element != CORE_NO_ELEMENT;
    elvis_real value = elvis_real(0);
    if (has_found) {
        value = core_shown_value(found.element, elvis_vec3(found.x, found.y, found.z));
    }
    const bool is_cut_short = found.is_cut_short || core_has_driver_given_up(core_size.x >> 31);
    // Where octants are still missing the search is done again.
    const bool is_done = is_wanted && !search.has_asked;
    uint n_evaluations = 0u;
    if (is_done && (has_found || is_cut_short)) {
        n_evaluations = core_merge(pixel, point, found, value);
#if !CORE_ON_PLANE
        if (n_evaluations > 0u && core_wants_places != 0u) {
            core_places[pixel] = core_place(found.x, found.y, found.z, found.element, CORE_CLASS << CORE_PLACE_FACE_BITS);
        }
#endif
    }
    if (is_done && !has_found && (search.is_undecided || is_cut_short)) {
        core_marks[pixel].flags |= CORE_FLAG_UNDECIDED;
    }
    core_count(0u, n_evaluations);
    core_count(1u, found.n_steps);
#if !CORE_ON_PLANE
    core_count(3u, n_evaluations > 0u ? 1u : 0u);
#endif
}
