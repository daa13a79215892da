// Segments of rays: their parts inside of elements, front to back, without overlaps (segments/neighbour_walk.glsl). Where walks of elements
// overlap, the one entered first owns the ray to its exit, and of the others counts what is left beyond it.
//
// One invocation a ray, for the elements of one class. That one element is left where the next one is entered shows as two
// parameters that agree within their errors: then the next segment begins with the end of this one, exactly. Wider gaps stay.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "picture/samples.glsl"
#include "segments/segment_state.glsl"

layout(set = 0, binding = 1, std430) buffer core_states_block { core_segment_state core_states[]; };
struct core_segment_record {
    elvis_real enter, leave, error;
    // CORE_ESTIMATED_SEGMENT where its ends are.
    uint element;
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
    // The diagonal of the volume's bounds.
    float core_extent;
};

#define CORE_RAYS_BINDING 4
#include "segments/source_ray.glsl"
#include "arithmetic/driver_limit.glsl"
#define CORE_ASSUMED_CURVATURE elvis_real(64)
#define CORE_CERTAIN_ITERATIONS 512u
#define CORE_SEGMENT_ITERATIONS 640u
#include "segments/segment.glsl"
#include "segments/traced_ray.glsl"
#include "segments/neighbour_walk.glsl"

// Elements of a ray in one dispatch, and iterations, with all loops inside below where drivers end them.
#define CORE_MOST_ELEMENTS 256u
#define CORE_WORK_LIMIT 2500u
// Over the tolerance of ends: how far apart parts of a walk may be where a ray runs through edges.
#define CORE_WIDEST_BREAK 64

void main() {
    const uint column = gl_GlobalInvocationID.x, row = core_first_row + gl_WorkGroupID.y;
    const bool is_ray = column < core_size.x && row < core_size.y;
    const uint index = is_ray ? row * core_size.x + column : 0u;
    core_segment_state state = core_states[index];
    const core_traced_ray ray = core_traced_ray_of(core_source_ray(column, row, index), elvis_real(core_extent));
    const elvis_real to = core_source_ray_end(index);
    core_walk walk = core_walk(state.done, state.walk, state.start, state.start_element, state.element,
                                  is_ray ? state.status : CORE_RAY_ENDS, 0u, false, false, false, false);
    bool is_mine;
    bool goes = core_walk_begin(walk, to, CORE_RAY_ENDS, is_mine);
    elvis_real done_error = state.done_error, walk_error = state.walk_error, sum = state.sum;
    bool is_done_estimated = state.is_estimated != 0u;
    bool is_first = is_mine && walk.at == walk.start;
    uint n_segments = state.n_segments, flags = 0u;
    uint n_elements = 0u, n_made = 0u, n_evaluations = 0u, n_overlaps = 0u, n_failures = 0u, n_estimated = 0u, n_breaks = 0u;
    core_segment segment;
    segment.element = 0u;
    segment.next = segment.anchor = segment.x = segment.y = segment.z = elvis_real(0);
    segment.slope_x = segment.slope_y = segment.slope_z = elvis_real(0);
    segment.iterations = 0u;
    const uint most = core_capacity > 0u ? core_capacity : 0xffffffffu;
    // What few rays need stands outside of the loop over elements (segments/neighbour_walk.glsl).
    while (goes && n_elements < CORE_MOST_ELEMENTS && n_evaluations < CORE_WORK_LIMIT && n_segments < most) {
        while (goes && n_elements < CORE_MOST_ELEMENTS && n_evaluations < CORE_WORK_LIMIT && n_segments < most) {
            n_elements += 1u;
            const core_reach reach = core_walk_reach(ray, walk, segment);
            flags |= reach.flags;
            n_evaluations += segment.iterations;
            n_failures += walk.needs_roughly ? 1u : 0u;
            const elvis_real leave_error = reach.is_met ? segment.leave_error : walk_error;
            const elvis_real errors = done_error + leave_error;
            // A walk that begins may begin behind a gap. On its way there is none, but where an edge hid the next element.
            const elvis_real rounding = elvis_real(2) * (done_error + walk_error), gap = walk.at - walk.done;
            const bool is_joined = gap <= max(rounding, (is_first ? elvis_real(1) : elvis_real(CORE_WIDEST_BREAK)) * ray.tolerance);
            const bool is_behind = gap < elvis_real(0);
            n_overlaps += reach.is_met && gap < -rounding && reach.leave - walk.at > errors ? 1u : 0u;
            const elvis_real from = is_joined ? walk.done : walk.at, until = min(reach.leave, to);
            // What was settled before but for rounding does not count.
            const bool is_segment = reach.is_met && until - from > (is_behind ? errors : elvis_real(0));
            // Where the ray has left the element before is somewhere on the way to here.
            const bool is_uncertain = walk.is_ahead && (walk.n_lost > 1u || segment.leave <= walk.at + ray.tolerance);
            if (is_uncertain && n_segments > 0u && core_capacity > 0u) {
                core_segments[index * core_capacity + n_segments - 1u].element |= CORE_ESTIMATED_SEGMENT;
            }
            const bool is_own_estimated = segment.is_estimated || is_uncertain;
            const bool is_estimated = is_own_estimated || (is_joined && is_done_estimated);
            if (is_segment && core_capacity > 0u) {
                const uint word = walk.element | (is_estimated ? CORE_ESTIMATED_SEGMENT : 0u);
                core_segments[index * core_capacity + n_segments] =
                    core_segment_record(from, until, max(is_joined ? done_error : walk_error, leave_error), word);
            }
            sum += is_segment ? until - from : elvis_real(0);
            n_segments += is_segment ? 1u : 0u;
            n_made += is_segment ? 1u : 0u;
            n_estimated += is_segment && is_estimated ? 1u : 0u;
            walk.done = is_segment ? until : walk.done;
            is_done_estimated = is_segment ? is_own_estimated : is_done_estimated || is_uncertain || (reach.is_met && segment.is_estimated);
            done_error = is_segment ? leave_error : done_error;
            walk_error = leave_error;
            is_first = is_first && walk.needs_roughly;
            const bool is_over = reach.is_met && reach.leave >= to;
            if (!is_over) {
                core_walk_go_on(ray, walk, segment, reach, from);
            }
            n_breaks += walk.needs_element ? 1u : 0u;
            walk.status = is_over ? CORE_RAY_ENDS : walk.status;
            goes = core_walk_goes(walk);
            if (!goes || subgroupAny(core_walk_needs_help(walk))) {
                break;
            }
        }
        core_walk_help(ray, walk, segment, flags);
        goes = core_walk_goes(walk);
        if (!goes) {
            break;
        }
    }
    const bool is_cut_short = core_has_driver_given_up(core_zero), seeks = walk.status == CORE_RAY_SEEKS;
    const bool is_full = n_segments >= most;
    flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u;
    if (is_mine) {
        state.done = walk.done;
        state.walk = seeks ? CORE_FAR : walk.at;
        state.start = walk.start;
        state.start_element = walk.start_element;
        state.done_error = done_error;
        state.walk_error = walk_error;
        state.sum = sum;
        state.element = seeks ? CORE_NO_ELEMENT : walk.element;
        state.status = is_cut_short ? CORE_RAY_ENDS : walk.status;
        state.flags |= flags;
        state.n_segments = n_segments;
        state.is_estimated = is_done_estimated ? 1u : 0u;
        core_states[index] = state;
    }
    const uint all_moved = subgroupAdd(is_mine ? 1u : 0u), all_segments = subgroupAdd(n_made), all_evaluations = subgroupAdd(n_evaluations);
    const uint all_overlaps = subgroupAdd(n_overlaps), all_failures = subgroupAdd(n_failures), all_estimated = subgroupAdd(n_estimated);
    const uint all_breaks = subgroupAdd(n_breaks), all_full = subgroupAdd(is_mine && is_full ? 1u : 0u);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_moved);
        atomicAdd(core_counts[1], all_segments);
        atomicAdd(core_counts[2], all_evaluations);
        atomicAdd(core_counts[3], all_overlaps);
        atomicAdd(core_counts[4], all_failures);
        atomicAdd(core_counts[5], all_estimated);
        atomicAdd(core_counts[6], all_breaks);
        atomicAdd(core_counts[7], all_full);
    }
}
