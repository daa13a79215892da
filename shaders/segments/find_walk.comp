// For rays that look for their next walk (segments/walk_state.glsl): the nearest start in the elements of one class, by a face without
// neighbour. Those that start at the eye do so before (segments/start_at_eye.comp).
//
// A hierarchy over the elements in which rays can start, of which each tile of pixels has a list (tiles/ray_tiles.comp). Rays that are
// given one by one descend from its root.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "picture/samples.glsl"
#include "tiles/ray_tiles.glsl"
#if CORE_MAKES_SEGMENTS
#include "segments/segment_state.glsl"
#define CORE_STATE core_segment_state
#else
#include "volume/volume_state.glsl"
#define CORE_STATE core_volume_state
#endif

layout(set = 0, binding = 1, std430) buffer core_states_block { CORE_STATE core_states[]; };
// Not read where rays are given.
layout(set = 0, binding = 2) CORE_READ_WORDS(core_tiles);
// Rays that look for a start, evaluations.
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_tiles_per_row;
    // In the list of groups; not read where rays are given.
    uint core_first_group;
    // Among all elements of the volume.
    uint core_first_element;
    uint core_zero;
    // The diagonal of the volume's bounds; what its positions are off before any of it is evaluated.
    float core_extent, core_data_error;
    // Elements may overlap over this length: as far before the end of the last walk starts are looked for.
    float core_overlap_length;
};

#if CORE_RAYS_ARE_GIVEN
#define CORE_RAYS_BINDING 4
#else
#define CORE_GROUPS_BINDING 4
#include "tiles/listed_group.glsl"
#endif
#include "segments/source_ray.glsl"
#include "arithmetic/driver_limit.glsl"
// In elements that are bent much, faces are searched instead.
#define CORE_WITHOUT_BENDS
#include "segments/segment.glsl"
#include "segments/start_bounds.glsl"
#include "arithmetic/count.glsl"
#if CORE_HAS_CURVED
#include "segments/face_search.glsl"
#endif

// Iterations of a ray, with all loops inside below where drivers end them.
#define CORE_WORK_LIMIT 2500u

// Error of starts that are not found at a face, in tolerances: up to 11 were seen in 40,000 rays.
#define CORE_LATE_ERROR elvis_real(16)

// Nodes of the hierarchy that are still to be looked at.
uint core_stack[CORE_STACK_SIZE];

// For the nearest start behind that of the last walk.
struct core_start_search {
    // The last walk's start, and the nearest one so far.
    core_walk_state walk;
    elvis_real at_error;
    // There is no last walk. Starts before `from`, the eye, do not count.
    bool is_first;
    elvis_real from;
    // Where the tile's list begins, its next entry, and how many it has.
    uint list, entry, n_entries;
    uint stack_size;
    uint work, n_evaluations;
    // The ray is followed through an element; it has entered its next segment there.
    bool is_following, has_entered;
};

bool core_has_nodes(const core_start_search search) { return search.stack_size > 0u || search.entry < search.n_entries; }

// If two starts are equally near, the one in the higher global element counts as behind.
bool core_is_behind_last(const core_traced_ray ray, elvis_real t, uint global_element, const core_start_search search) {
    const bool is_tied = abs(t - search.walk.start) <= elvis_real(2) * ray.tolerance;
    return is_tied ? global_element > search.walk.global_start_element : t > search.walk.start;
}

void core_take_start(bool is_start, elvis_real t, elvis_real error, uint global_element, inout core_start_search search) {
    const bool is_better = is_start && (t < search.walk.at || (t == search.walk.at && global_element < search.walk.global_element));
    search.walk.at = is_better ? t : search.walk.at;
    search.at_error = is_better ? error : search.at_error;
    search.walk.global_element = is_better ? global_element : search.walk.global_element;
}

// An element that the ray may meet between `from` and `to`.
struct core_start_candidate {
    bool is_there;
    uint element;
    elvis_real from, to;
};

// Looks at one node, and puts those below it on the stack.
core_start_candidate core_next_node(core_ray ray, inout core_start_search search) {
    search.work += 1u;
    const bool is_popped = search.stack_size > 0u;
#if CORE_RAYS_ARE_GIVEN
    const uint listed = 0u;
    const bool is_behind = false;
#else
    const uint at = search.list + 1u + 2u * min(search.entry, search.n_entries - 1u), listed = CORE_WORD(core_tiles, at);
    const bool is_behind = !is_popped && uintBitsToFloat(CORE_WORD(core_tiles, at + 1u)) > float(search.walk.at);
#endif
    const uint word = is_popped ? core_stack[search.stack_size - (is_popped ? 1u : 0u)] : listed;
    search.stack_size -= is_popped ? 1u : 0u;
    search.entry = is_popped ? search.entry : (is_behind ? search.n_entries : search.entry + 1u);
    const core_node node = core_fetch_node(word & ~CORE_TILE_INNER);
    const vec2 span = core_box_span(node, ray);
    const bool is_touched = !is_behind && span.x <= span.y && span.y >= float(search.from) && span.x <= float(search.walk.at);
    if (is_touched && !node.is_leaf) {
        core_stack[search.stack_size] = node.child + 1u;
        core_stack[search.stack_size + 1u] = node.child;
        search.stack_size += 2u;
    }
    return core_start_candidate(is_touched && node.is_leaf, node.child, elvis_real(span.x), elvis_real(span.y));
}

// Starts with the ray's segments in the candidate, if it may hold a start.
void core_follow_candidate(core_ray pixel_ray, const core_traced_ray ray, core_start_candidate candidate, inout core_segment segment,
                           inout core_start_search search) {
    const elvis_real begin = search.is_first ? max(candidate.from, search.from) : candidate.from;
    const elvis_real end = min(candidate.to, begin + ray.longest);
    // The last walk, if there is one, may have begun at the eye.
    const bool is_taken =
        !search.is_first && core_first_element + candidate.element == search.walk.global_start_element && search.walk.start > pixel_ray.least_t;
    const bool may_start = core_may_start(ray, candidate.element, begin, end, search.is_first ? begin : search.from, is_taken);
    search.is_following = core_segment_begin(ray, candidate.element, begin, end, false, segment) && may_start;
    search.has_entered = false;
}

// The next element on the way through the hierarchy, if there is one.
core_start_candidate core_next_start_candidate(core_ray pixel_ray, inout core_start_search search) {
    core_start_candidate candidate = core_start_candidate(false, 0u, elvis_real(0), elvis_real(0));
    while (!candidate.is_there && core_has_nodes(search) && search.work < CORE_WORK_LIMIT) {
        candidate = core_next_node(pixel_ray, search);
        if (candidate.is_there || !core_has_nodes(search)) {
            break;
        }
    }
    return candidate;
}

#if CORE_HAS_CURVED
// In an element so curved that bounds tell little: through each face by which the ray may come in.
void core_start_in_curved(const core_traced_ray ray, vec3 along, bool is_curved, inout core_segment segment,
                          inout core_start_search search) {
    const uint global_element = core_first_element + segment.element;
    const elvis_real rounding = elvis_real(2) * ray.tolerance;
    core_face_search faces = core_face_search(0u, 0u, CORE_WHOLE_FACE, 0u, 0u, false, elvis_real(0), elvis_real(0));
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const bool is_unlinked = elvis_fetch_core_links(segment.element, uint(face)) == CORE_NO_LINK;
        faces.open |= is_curved && is_unlinked && !core_surely_crosses(segment.element, face, along, 1.0) ? 1u << face : 0u;
        faces.once |= core_surely_crosses(segment.element, face, along, -1.0) ? 1u << face : 0u;
    }
    while (faces.open != 0u) {
        const core_face_entry entry =
            core_search_face(ray, segment.element, search.from - rounding, search.walk.at + rounding, faces);
        search.n_evaluations += 1u;
        search.work += 1u;
        const bool is_after = search.is_first ? entry.t >= search.from : core_is_behind_last(ray, entry.t, global_element, search);
        core_take_start(entry.is_found && is_after, entry.t, entry.error, global_element, search);
        search.walk.flags |= entry.is_undecided ? CORE_FLAG_UNDECIDED : 0u;
        if (faces.open == 0u) {
            break;
        }
    }
    search.is_following = search.is_following && !is_curved;
}
#endif

// Whether the ray enters the element through a face without neighbour, or through one that is as near within rounding.
bool core_enters_volume(const core_segment segment, const core_traced_ray ray) {
    const elvis_vec3 at = core_predicted(segment.anchor, segment.enter), slope = abs(core_slope_of(segment.anchor));
    const elvis_real near =
        elvis_real(8) * ray.tolerance * (slope.x + slope.y + slope.z) + elvis_real(64) * CORE_ROUNDOFF + core_max_norm(segment.noise);
    bool enters = false;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const bool is_unlinked = elvis_fetch_core_links(segment.element, uint(face)) == CORE_NO_LINK;
        const bool is_near = face == segment.enter_face || dot(constraint.xyz, at) + constraint.w > -near;
        enters = enters || (is_unlinked && is_near);
    }
#if ELVIS_HAS_INSIDE
    const core_inside g = core_inside_at(segment.element, at);
    enters = enters || segment.enter_face == CORE_INSIDE_FACE || g.value > -(near * core_max_norm(abs(g.slope)) + g.rounding);
#endif
    return enters;
}

// What an iteration of the search for the ray's segments in the element tells. If a segment does not begin at a wanted start, the search
// follows it to its end. True if it is to look behind that.
bool core_follow(const core_traced_ray ray, uint ending, const core_segment segment, inout core_start_search search) {
    const bool is_following = search.is_following;
    search.n_evaluations += is_following ? 1u : 0u;
    // What is behind in the element is then not looked for.
    search.walk.flags |= is_following && ending != CORE_SEGMENT_OPEN && segment.has_failed ? CORE_FLAG_UNDECIDED : 0u;
    const uint global_element = core_first_element + segment.element;
    const bool is_newly_inside = is_following && segment.is_inside && !search.has_entered;
    search.has_entered = search.has_entered || is_newly_inside;
    // Where rounding hides whether the ray enters, it may go on from there into an element that has an edge in the boundary, but no face.
    const bool is_touching = is_following && segment.is_touched;
    bool is_start = false;
    if ((is_newly_inside || is_touching) && (search.is_first || core_is_behind_last(ray, segment.enter, global_element, search))) {
        is_start = core_enters_volume(segment, ray);
    }
    // Where no face is met it was said too early, by estimates, that the ray is outside.
    const bool is_late = segment.enter_face < 0;
    const elvis_real error = is_late ? max(CORE_LATE_ERROR * ray.tolerance, segment.enter_error) : segment.enter_error;
    core_take_start(is_start, segment.enter, error, global_element, search);
    search.is_following = is_following && !is_start && ending == CORE_SEGMENT_OPEN;
    return ending == CORE_SEGMENT_FOUND && !is_start && segment.resume < segment.last;
}

core_start_search core_search_begin(CORE_STATE state, elvis_real least_t, elvis_real speed, uvec2 place, bool is_mine) {
    core_start_search search;
    search.walk = state.walk;
#if CORE_MAKES_SEGMENTS
    search.at_error = state.at_error;
#else
    search.at_error = elvis_real(0);
#endif
    search.is_first = state.walk.global_start_element == CORE_NO_ELEMENT;
    search.from = search.is_first ? least_t : max(state.walk.start, state.walk.done - elvis_real(core_overlap_length) / speed);
#if CORE_RAYS_ARE_GIVEN
    search.list = 0u;
    search.n_entries = is_mine ? 1u : 0u;
#else
    search.list = (place.x / CORE_TILE_WIDTH + place.y / CORE_TILE_HEIGHT * core_tiles_per_row) * CORE_TILE_STRIDE;
    search.n_entries = is_mine ? CORE_WORD(core_tiles, search.list) & ~CORE_TILE_INNER : 0u;
#endif
    search.entry = search.stack_size = search.work = search.n_evaluations = 0u;
    search.is_following = search.has_entered = false;
    return search;
}

void main() {
#if CORE_RAYS_ARE_GIVEN
    const uvec2 place = uvec2(gl_GlobalInvocationID.x, 0u);
#else
    const uvec2 place = core_group_pixel(core_first_group, core_size.x);
#endif
    const bool is_pixel = place.x < core_size.x && place.y < core_size.y;
    const uint pixel = is_pixel ? place.y * core_size.x + place.x : 0u;
    const CORE_STATE state = core_states[pixel];
    const bool is_mine = is_pixel && (state.walk.status == CORE_RAY_SEEKS || state.walk.status == CORE_RAY_HAS_SOUGHT);
    const core_ray pixel_ray = core_source_ray(place.x, place.y, pixel);
    const core_traced_ray ray = core_traced_ray_of(pixel_ray, elvis_real(core_extent), elvis_real(core_data_error));
    core_start_search search = core_search_begin(state, pixel_ray.least_t, ray.speed, place, is_mine);
    core_segment segment = core_no_segment();
    const vec3 along = vec3(ray.direction / ray.speed);
    while ((search.is_following || core_has_nodes(search)) && search.work < CORE_WORK_LIMIT) {
        search.work += 1u;
        // The next element that may hold a start.
        while (!search.is_following && core_has_nodes(search) && search.work < CORE_WORK_LIMIT) {
            const core_start_candidate candidate = core_next_start_candidate(pixel_ray, search);
            if (candidate.is_there) {
                core_follow_candidate(pixel_ray, ray, candidate, segment, search);
            }
            if (search.is_following || !core_has_nodes(search)) {
                break;
            }
        }
#if CORE_HAS_CURVED
        core_start_in_curved(ray, along, search.is_following && segment.curvature > CORE_FOLLOWED_CURVATURE, segment, search);
#endif
        const uint ending = search.is_following ? core_segment_iterate(ray, segment.element, segment) : CORE_SEGMENT_NONE;
        if (core_follow(ray, ending, segment, search)) {
            const elvis_real resume = max(segment.resume, segment.leave) + ray.tolerance;
            search.is_following = core_segment_begin(ray, segment.element, resume, segment.last, false, segment);
            search.has_entered = false;
        }
        if (!search.is_following && !core_has_nodes(search)) {
            break;
        }
    }
    const bool is_cut_short = search.is_following || core_has_nodes(search) || core_has_driver_given_up(core_zero);
    search.walk.status = CORE_RAY_HAS_SOUGHT;
    search.walk.flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u;
    if (is_mine) {
        core_states[pixel].walk = search.walk;
#if CORE_MAKES_SEGMENTS
        core_states[pixel].at_error = search.at_error;
#endif
    }
    core_count(0u, is_mine ? 1u : 0u);
    core_count(1u, search.n_evaluations);
}
