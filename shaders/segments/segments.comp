// Lists of the segments of rays, front to back, without overlaps (segments/neighbour_walk.glsl). Where walks overlap, the one that begins
// first owns the ray to its end; of the others counts what lies beyond it.
//
// One invocation a ray, for the elements of one class. An element is left where the next one is entered if the two parameters agree within
// their errors: the next segment then begins exactly where this one ends. Wider gaps stay.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "picture/samples.glsl"
#include "segments/segment_state.glsl"

layout(set = 0, binding = 1, std430) buffer core_states_block { core_segment_state core_states[]; };
struct core_segment_record {
    elvis_real enter, leave, error;
    // With CORE_ESTIMATED_SEGMENT where its ends are estimated.
    uint global_element;
};
#define CORE_ESTIMATED_SEGMENT 0x80000000u
// core_capacity of them a ray.
layout(set = 0, binding = 2, std430) buffer core_segments_block { core_segment_record core_segments[]; };
// Rays that this dispatch has moved, segments, evaluations, overlaps, failures, estimated segments, breaks of walks, rays whose list is
// full.
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first_row;
    uint core_first_element, core_n_elements;
    // 0: no lists are made.
    uint core_capacity;
    uint core_zero;
    // The diagonal of the volume's bounds; what its positions are off before any of it is evaluated.
    float core_extent, core_data_error;
};

#define CORE_RAYS_BINDING 4
#include "segments/source_ray.glsl"
#include "arithmetic/driver_limit.glsl"
#define CORE_ASSUMED_CURVATURE elvis_real(64)
#define CORE_CERTAIN_ITERATIONS 512u
#define CORE_SEGMENT_ITERATIONS 640u
#define CORE_REMEMBERS_ENTRY CORE_HAS_CURVED
#include "segments/segment.glsl"
#include "segments/neighbour_walk.glsl"
#include "arithmetic/count.glsl"

// Elements of a ray in one dispatch, and iterations, with all loops inside below where drivers end them.
#define CORE_MOST_ELEMENTS 256u
#define CORE_WORK_LIMIT 2500u
// Over the tolerance of ends: how far apart segments of a walk may be where a ray runs through edges.
#define CORE_WIDEST_BREAK 64

// A ray's list.
struct core_segment_list {
    uint ray, capacity;
    // No segment of the walk has been looked for yet.
    bool is_first;
    // Errors of walk.done and walk.at.
    elvis_real done_error, at_error;
    bool is_done_estimated;
    elvis_real sum;
    uint n_segments;
    // In this dispatch.
    uint n_made, n_overlaps, n_estimated;
};

// The end of the last segment.
void core_mark_estimated(core_segment_list list) {
    if (list.n_segments > 0u && list.capacity > 0u) {
        core_segments[list.ray * list.capacity + list.n_segments - 1u].global_element |= CORE_ESTIMATED_SEGMENT;
    }
}

void core_append(uint global_element, elvis_real from, elvis_real until, elvis_real error, bool is_estimated,
                 inout core_segment_list list) {
    if (list.capacity > 0u) {
        core_segments[list.ray * list.capacity + list.n_segments] =
            core_segment_record(from, until, error, global_element | (is_estimated ? CORE_ESTIMATED_SEGMENT : 0u));
    }
    list.sum += until - from;
    list.n_segments += 1u;
    list.n_made += 1u;
    list.n_estimated += is_estimated ? 1u : 0u;
}

// The ray's segment in the element that the walk is in, up to `to`. Returns where it begins.
elvis_real core_list_segment(core_traced_ray ray, core_segment segment, core_passage passage, elvis_real to, inout core_walk walk,
                             inout core_segment_list list) {
    const elvis_real leave_error = passage.is_met ? segment.leave_error : list.at_error, errors = list.done_error + leave_error;
    // A walk that begins may begin behind a gap. On its way there is none, but where an edge hid the next element.
    const elvis_real rounding = elvis_real(2) * (list.done_error + list.at_error), gap = walk.at - walk.done;
    const bool is_joined = gap <= max(rounding, (list.is_first ? elvis_real(1) : elvis_real(CORE_WIDEST_BREAK)) * ray.tolerance);
    list.n_overlaps += passage.is_met && gap < -rounding && passage.leave - walk.at > errors ? 1u : 0u;
    const elvis_real from = is_joined ? walk.done : walk.at, until = min(passage.leave, to);
    // What was done before but for rounding does not count.
    const bool is_segment = passage.is_met && until - from > (gap < elvis_real(0) ? errors : elvis_real(0));
    // Where the ray has left the element before is somewhere on the way to here.
    const bool is_uncertain = walk.is_ahead && (walk.n_lost > 1u || segment.leave <= walk.at + ray.tolerance);
    if (is_uncertain) {
        core_mark_estimated(list);
    }
    const bool is_end_estimated = segment.is_estimated || is_uncertain;
    if (is_segment) {
        core_append(walk.global_element, from, until, max(is_joined ? list.done_error : list.at_error, leave_error),
                    is_end_estimated || (is_joined && list.is_done_estimated), list);
    }
    walk.done = is_segment ? until : walk.done;
    list.is_done_estimated =
        is_segment ? is_end_estimated : list.is_done_estimated || is_uncertain || (passage.is_met && segment.is_estimated);
    list.done_error = is_segment ? leave_error : list.done_error;
    list.at_error = leave_error;
    list.is_first = list.is_first && walk.needs_roughly;
    return from;
}

void main() {
    const uint column = gl_GlobalInvocationID.x, row = core_first_row + gl_WorkGroupID.y;
    const bool is_ray = column < core_size.x && row < core_size.y;
    const uint index = is_ray ? row * core_size.x + column : 0u;
    const core_segment_state state = core_states[index];
    const core_traced_ray ray = core_traced_ray_of(core_source_ray(column, row, index), elvis_real(core_extent), elvis_real(core_data_error));
    const elvis_real to = core_source_ray_end(index);
    core_walk walk = core_walk_begin(state.walk, is_ray, to, CORE_RAY_ENDS);
    core_segment_list list =
        core_segment_list(index, core_capacity, walk.is_mine && walk.at == walk.start, state.done_error, state.at_error,
                          state.is_estimated != 0u, state.sum, state.n_segments, 0u, 0u, 0u);
    uint n_elements = 0u, n_evaluations = 0u, n_failures = 0u, n_breaks = 0u;
    core_segment segment = core_no_segment();
    const uint most = core_capacity > 0u ? core_capacity : 0xffffffffu;
    bool goes = core_walk_goes_here(walk);
    while (goes && n_elements < CORE_MOST_ELEMENTS && n_evaluations < CORE_WORK_LIMIT && list.n_segments < most) {
        while (goes && n_elements < CORE_MOST_ELEMENTS && n_evaluations < CORE_WORK_LIMIT && list.n_segments < most) {
            n_elements += 1u;
            const core_passage passage = core_walk_pass(ray, walk, segment);
            n_evaluations += segment.iterations;
            n_failures += walk.needs_roughly ? 1u : 0u;
            const elvis_real from = core_list_segment(ray, segment, passage, to, walk, list);
            const bool is_over = passage.is_met && passage.leave >= to;
            if (!is_over) {
                core_walk_go_on(ray, segment.leave_face, passage, from, walk);
            }
            n_breaks += walk.needs_element ? 1u : 0u;
            walk.status = is_over ? CORE_RAY_ENDS : walk.status;
            goes = core_walk_goes_here(walk);
            if (!goes || subgroupAny(core_walk_needs_help(walk))) {
                break;
            }
        }
        core_walk_help(ray, walk, segment);
        goes = core_walk_goes_here(walk);
        if (!goes) {
            break;
        }
    }
    const core_walk_state end = core_walk_end(walk);
    if (walk.is_mine) {
        core_states[index] = core_segment_state(end, list.done_error, list.at_error, list.sum, list.n_segments,
                                                list.is_done_estimated ? 1u : 0u);
    }
    core_count(0u, uvec4(walk.is_mine ? 1u : 0u, list.n_made, n_evaluations, list.n_overlaps));
    core_count(4u, uvec4(n_failures, list.n_estimated, n_breaks, walk.is_mine && list.n_segments >= most ? 1u : 0u));
}
