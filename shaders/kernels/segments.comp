// Segments of rays in the elements of one class (library/ray_segments.glsl), as lists: an invocation a ray.
//
// A ray that fills its list, or takes the turns of one dispatch, goes on in the next one from where it is done.

layout(local_size_x = 32) in;

#include "library/driver_limit.glsl"

layout(set = 0, binding = 0, std140) uniform core_frame_block {
    // Of the hierarchies' origin in the world; w: distance within which ends are wanted.
    elvis_vec4 core_centre;
};
#define CORE_CENTRE core_centre.xyz

#include "library/ray_segments.glsl"

// Relative to the hierarchies' origin; (origin, from), (direction, to) for each ray.
layout(set = 0, binding = 1, std430) readonly buffer core_rays_block { elvis_vec4 core_rays[]; };
struct core_ray_state {
    elvis_real done, done_error;
    // Segments in the list; whether the ray is done.
    uint n_segments, is_over;
};
layout(set = 0, binding = 2, std430) buffer core_states_block { core_ray_state core_states[]; };
struct core_segment {
    elvis_real enter, leave, error;
    // CORE_ESTIMATED_PART where its ends are.
    uint element;
};
// Capacity of them a ray; with capacity 0 one, that has the sum of the lengths as `enter`.
layout(set = 0, binding = 3, std430) buffer core_segments_block { core_segment core_segments[]; };
// Segments, evaluations, overlaps, failures, estimated segments, rays that are not over, turns, breaks of chains.
layout(set = 0, binding = 4, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uint core_first_ray, core_n_rays;
    uint core_capacity;
    uint core_n_turns;
    uint core_zero;
    float core_wanted_from, core_wanted_to;
};

void main() {
    const uint ray_index = core_first_ray + gl_GlobalInvocationID.x;
    const bool is_ray = ray_index < core_n_rays;
    const uint index = min(ray_index, core_n_rays - 1u);
    const core_ray_state state = core_states[index];
    const elvis_vec4 row0 = core_rays[2u * index], row1 = core_rays[2u * index + 1u];
    core_walk_ray ray;
    ray.origin = row0.xyz;
    ray.direction = row1.xyz;
    ray.error = elvis_real(0);
    ray.speed = length(ray.direction);
    ray.reach = elvis_real(1);
    ray.tolerance = core_centre.w / ray.speed;
    core_walk walk = core_begin_walk(ray, state.done, state.done_error, row1.w);
    walk.wanted = vec2(core_wanted_from, core_wanted_to);
    const bool is_open = is_ray && state.is_over == 0u;
    walk.state = is_open ? walk.state : CORE_WALK_DONE;

    uint n_turns = 0u, n_segments = 0u, n_estimated = 0u;
    elvis_real sum = elvis_real(0);
    const uint most = core_capacity > 0u ? core_capacity : 0xffffffffu;
    while (walk.state != CORE_WALK_DONE && n_turns < core_n_turns && n_segments < most) {
        n_turns += 1u;
        core_walk_turn(walk);
        const bool is_segment = walk.state == CORE_WALK_SEGMENT;
        sum += is_segment ? walk.leave - walk.enter : elvis_real(0);
        n_estimated += is_segment && walk.is_estimated ? 1u : 0u;
        for (uint turn = 0u; turn < (is_segment && core_capacity > 0u ? 1u : 0u); ++turn) {
            core_segments[index * core_capacity + n_segments] =
                core_segment(walk.enter, walk.leave, walk.error, walk.element | (walk.is_estimated ? CORE_ESTIMATED_PART : 0u));
        }
        n_segments += is_segment ? 1u : 0u;
    }
    const bool is_cut_short = core_has_driver_given_up(core_zero);
    for (uint turn = 0u; turn < (is_ray ? 1u : 0u); ++turn) {
        core_states[index].n_segments = is_open ? n_segments : 0u;
    }
    for (uint turn = 0u; turn < (is_open ? 1u : 0u); ++turn) {
        core_states[index].done = walk.done;
        core_states[index].done_error = walk.done_error;
        core_states[index].is_over = walk.state == CORE_WALK_DONE && !is_cut_short ? 1u : 0u;
        for (uint second = 0u; second < (core_capacity == 0u ? 1u : 0u); ++second) {
            core_segments[index].enter += sum;
        }
    }
    const bool is_left = is_open && (walk.state != CORE_WALK_DONE || is_cut_short);
    const uint all_segments = subgroupAdd(is_open ? n_segments : 0u), all_evaluations = subgroupAdd(is_open ? walk.n_evaluations : 0u);
    const uint all_overlaps = subgroupAdd(is_open ? walk.n_overlaps : 0u), all_failures = subgroupAdd(is_open ? walk.n_failures : 0u);
    const uint all_estimated = subgroupAdd(is_open ? n_estimated : 0u), all_left = subgroupAdd(is_left ? 1u : 0u);
    const uint all_turns = subgroupAdd(is_open ? n_turns : 0u), all_breaks = subgroupAdd(is_open ? walk.n_breaks : 0u);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_segments);
        atomicAdd(core_counts[1], all_evaluations);
        atomicAdd(core_counts[2], all_overlaps);
        atomicAdd(core_counts[3], all_failures);
        atomicAdd(core_counts[4], all_estimated);
        atomicAdd(core_counts[5], all_left);
        atomicAdd(core_counts[6], all_turns);
        atomicAdd(core_counts[7], all_breaks);
    }
}
