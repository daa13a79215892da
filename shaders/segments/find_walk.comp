// For rays that look for their next walk (segments/walk_state.glsl): the nearest start in the elements of one class.
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
layout(set = 0, binding = 2, std430) readonly buffer core_tiles_block { uint core_tiles[]; };
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
    // The diagonal of the volume's bounds.
    float core_extent;
};

#if CORE_RAYS_ARE_GIVEN
#define CORE_RAYS_BINDING 4
#else
#define CORE_GROUPS_BINDING 4
#include "tiles/ray_group.glsl"
#endif
#include "segments/source_ray.glsl"
#include "arithmetic/driver_limit.glsl"
#include "segments/segment.glsl"
#include "segments/traced_ray.glsl"
#include "segments/start_bounds.glsl"
#if CORE_HAS_CURVED
#include "segments/curved_start.glsl"
#endif

// Iterations of a ray, with all loops inside below where drivers end them.
#define CORE_WORK_LIMIT 2500u

// Error of starts that are not found at a face, in tolerances: up to 11 were seen in 40,000 rays.
#define CORE_LATE_ERROR elvis_real(16)

// Whether the ray comes into the element through a face without neighbour, or one that is as near within rounding.
bool core_enters_volume(core_segment segment, core_traced_ray ray) {
    const elvis_real since = segment.enter - segment.anchor;
    const elvis_vec3 at = elvis_vec3(segment.x, segment.y, segment.z) + since * elvis_vec3(segment.slope_x, segment.slope_y, segment.slope_z);
    const elvis_real near =
        elvis_real(8) * ray.tolerance * (abs(segment.slope_x) + abs(segment.slope_y) + abs(segment.slope_z)) + elvis_real(64) * CORE_ROUNDOFF;
    bool enters = false;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const bool is_open = elvis_fetch_core_links(segment.element, uint(face)) == CORE_NO_LINK;
        const bool is_near = face == segment.enter_face || dot(constraint.xyz, at) + constraint.w > -near;
        enters = enters || (is_open && is_near);
    }
#if ELVIS_HAS_INSIDE
    const core_inside g = core_inside_at(segment.element, at);
    enters = enters || segment.enter_face == CORE_INSIDE_FACE || g.value > -(near * core_max_norm(abs(g.slope)) + g.rounding);
#endif
    return enters;
}

void main() {
#if CORE_RAYS_ARE_GIVEN
    const uint column = gl_GlobalInvocationID.x, row = 0u;
#else
    const uvec2 place = core_group_pixel(core_first_group, core_size.x);
    const uint column = place.x, row = place.y;
#endif
    const bool is_pixel = column < core_size.x;
    const uint pixel = is_pixel ? row * core_size.x + column : 0u;
    const CORE_STATE state = core_states[pixel];
    const bool is_mine = is_pixel && (state.status == CORE_RAY_SEEKS || state.status == CORE_RAY_HAS_SOUGHT);
#if CORE_RAYS_ARE_GIVEN
    const uint n_listed = 1u;
#else
    const uint list = (column / CORE_TILE_WIDTH + row / CORE_TILE_HEIGHT * core_tiles_per_row) * CORE_TILE_STRIDE;
    const uint n_listed = core_tiles[is_pixel ? list : 0u] & ~CORE_TILE_INNER;
#endif
    const uint n_entries = is_mine ? n_listed : 0u;
    const core_ray pixel_ray = core_source_ray(column, row, pixel);
    const core_traced_ray ray = core_traced_ray_of(pixel_ray, elvis_real(core_extent));

    const vec3 along = vec3(ray.direction / length(ray.direction));
    // The first walk may start at the eye.
    const bool is_first = state.start_element == CORE_NO_ELEMENT;
    const elvis_real from = is_first ? pixel_ray.least_t : state.start;
    elvis_real best = state.walk;
    uint best_element = state.element;
#if CORE_MAKES_SEGMENTS
    elvis_real best_error = state.walk_error;
#endif

    uint stack[CORE_STACK_SIZE];
    uint stack_size = 0u, entry = 0u, work = 0u, n_evaluations = 0u;
    core_segment segment;
    segment.element = 0u;
    segment.next = segment.anchor = segment.x = segment.y = segment.z = elvis_real(0);
    segment.slope_x = segment.slope_y = segment.slope_z = elvis_real(0);
    segment.iterations = 0u;
    bool is_searching = false, has_entered = false, has_failed = false;
    while ((is_searching || stack_size > 0u || entry < n_entries) && work < CORE_WORK_LIMIT) {
        work += 1u;
        // An element that may hold a start.
        while (!is_searching && (stack_size > 0u || entry < n_entries) && work < CORE_WORK_LIMIT) {
            bool is_leaf = false;
            uint candidate = 0u;
            elvis_real box_from = elvis_real(0), box_to = elvis_real(0);
            while (!is_leaf && (stack_size > 0u || entry < n_entries) && work < CORE_WORK_LIMIT) {
                work += 1u;
                const bool is_popped = stack_size > 0u;
#if CORE_RAYS_ARE_GIVEN
                const uint listed = 0u;
                const bool is_behind = false;
#else
                const uint at = list + 1u + 2u * min(entry, n_listed - 1u);
                const uint listed = core_tiles[at];
                const bool is_behind = !is_popped && uintBitsToFloat(core_tiles[at + 1u]) > float(best);
#endif
                const uint word = is_popped ? stack[stack_size - (is_popped ? 1u : 0u)] : listed;
                stack_size -= is_popped ? 1u : 0u;
                entry = is_popped ? entry : (is_behind ? n_entries : entry + 1u);
                const core_node node = core_fetch_node(word & ~CORE_TILE_INNER);
                const vec2 span = core_box_span(node, pixel_ray);
                const bool is_touched = !is_behind && span.x <= span.y && span.y >= float(from) && span.x <= float(best);
                if (is_touched && !node.is_leaf) {
                    stack[stack_size] = node.child + 1u;
                    stack[stack_size + 1u] = node.child;
                    stack_size += 2u;
                }
                is_leaf = is_touched && node.is_leaf;
                candidate = node.child;
                box_from = elvis_real(span.x);
                box_to = elvis_real(span.y);
                if (is_leaf || (stack_size == 0u && entry >= n_entries)) {
                    break;
                }
            }
            if (is_leaf) {
                const elvis_real begin = is_first ? max(box_from, from) : box_from;
                const elvis_real end = min(box_to, begin + ray.reach);
                const bool is_around_eye = is_first && box_from <= from;
                const bool is_taken = !is_first && core_first_element + candidate == state.start_element && from > pixel_ray.least_t;
                const bool may_start = is_around_eye || core_may_start(ray, candidate, begin, end, is_first ? begin : from, is_taken);
                is_searching = core_segment_begin(ray, candidate, begin, end, false, segment) && may_start;
                has_entered = false;
            }
            if (is_searching || (stack_size == 0u && entry >= n_entries)) {
                break;
            }
        }
#if CORE_HAS_CURVED
        // Where bounds tell little.
        const bool is_curved = is_searching && segment.curvature > CORE_FOLLOWED_CURVATURE;
        if (is_curved && is_first && segment.anchor <= from) {
            const bool is_in = core_segment_enter(ray, elvis_real(0), segment);
            const uint element = core_first_element + segment.element;
            const bool is_better = is_in && (from < best || (from == best && element < best_element));
            n_evaluations += segment.iterations;
            best = is_better ? from : best;
            best_element = is_better ? element : best_element;
        }
        // Bits of the faces through which the ray may come in.
        uint open = 0u, start = 0u;
        core_face_exit face_exit = core_face_exit(false, elvis_vec3(0), elvis_vec3(0));
        for (int face = 0; face < CORE_N_FACES; ++face) {
            const bool is_open = elvis_fetch_core_links(segment.element, uint(face)) == CORE_NO_LINK;
            open |= is_curved && is_open && !core_surely_crosses(segment.element, face, along, 1.0) ? 1u << face : 0u;
        }
        while (open != 0u) {
            if (open != 0u) {
                const int face = findLSB(open);
                const core_face_entry entry = core_enter_face(ray, segment.element, segment.curvature, face, start, face_exit);
                const uint element = core_first_element + segment.element;
                n_evaluations += entry.n_evaluations;
                work += 1u;
                const bool is_tied = abs(entry.t - state.start) <= elvis_real(2) * ray.tolerance;
                const bool is_after = is_first ? entry.t >= from : is_tied ? element > state.start_element : entry.t > state.start;
                const bool is_better =
                    entry.is_found && is_after && (entry.t < best || (entry.t == best && element < best_element));
                best = is_better ? entry.t : best;
                best_element = is_better ? element : best_element;
#if CORE_MAKES_SEGMENTS
                best_error = is_better ? entry.error : best_error;
#endif
                // There is but one entry through a face with such directions (segments/start_bounds.glsl).
                const bool is_only = entry.is_found && core_surely_crosses(segment.element, face, along, -1.0);
                start = is_only ? CORE_FACE_STARTS : start + 1u;
                open = start < CORE_FACE_STARTS ? open : open & (open - 1u);
                face_exit.is_found = face_exit.is_found && start < CORE_FACE_STARTS;
                start = start < CORE_FACE_STARTS ? start : 0u;
            }
            if (open == 0u) {
                break;
            }
        }
        is_searching = is_searching && !is_curved;
#endif
        // A start that is not the one wanted is followed to where the ray leaves.
        const uint ending = is_searching ? core_segment_iterate(ray, is_searching, segment) : CORE_SEGMENT_NONE;
        n_evaluations += is_searching ? 1u : 0u;
        // What is behind in the element is then not looked for.
        has_failed = has_failed || (is_searching && ending != CORE_SEGMENT_OPEN && segment.has_failed);
        const uint element = core_first_element + segment.element;
        const bool is_entry = is_searching && segment.is_inside && !has_entered;
        has_entered = has_entered || is_entry;
        const bool is_at_eye = segment.enter_face < 0 && is_first && segment.enter <= from;
        const bool is_tied = abs(segment.enter - state.start) <= elvis_real(2) * ray.tolerance;
        const bool is_after = is_first || (is_tied ? element > state.start_element : segment.enter > state.start);
        bool is_start = false;
        if (is_entry && is_after) {
            is_start = is_at_eye || core_enters_volume(segment, ray);
        }
        const bool is_better = is_start && (segment.enter < best || (segment.enter == best && element < best_element));
        best = is_better ? segment.enter : best;
        best_element = is_better ? element : best_element;
#if CORE_MAKES_SEGMENTS
        // Where no face is met it was said too early, by estimates, that the ray is outside.
        const bool is_late = segment.enter_face < 0 && !is_at_eye;
        best_error = is_better ? (is_late ? CORE_LATE_ERROR * ray.tolerance : segment.enter_error) : best_error;
#endif
        const bool goes_on = ending == CORE_SEGMENT_FOUND && !is_start && segment.resume < segment.last;
        const elvis_real resume = max(segment.resume, segment.leave) + ray.tolerance;
        is_searching = is_searching && !is_start && ending == CORE_SEGMENT_OPEN;
        if (goes_on) {
            is_searching = core_segment_begin(ray, segment.element, resume, segment.last, false, segment);
            has_entered = false;
        }
        if (!is_searching && stack_size == 0u && entry >= n_entries) {
            break;
        }
    }
    const bool is_cut_short = is_searching || stack_size > 0u || entry < n_entries || core_has_driver_given_up(core_zero);
    if (is_mine) {
        core_states[pixel].status = CORE_RAY_HAS_SOUGHT;
        core_states[pixel].walk = best;
        core_states[pixel].element = best_element;
#if CORE_MAKES_SEGMENTS
        core_states[pixel].walk_error = best_error;
#endif
        core_states[pixel].flags |= (is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u) | (has_failed ? CORE_FLAG_UNDECIDED : 0u);
    }
    const uint all_open = subgroupAdd(is_mine ? 1u : 0u), all_evaluations = subgroupAdd(n_evaluations);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_open);
        atomicAdd(core_counts[1], all_evaluations);
    }
}
