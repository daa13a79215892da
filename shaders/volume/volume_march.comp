// Light along the rays of pixels, from element to element of one class (volume/volume_state.glsl).
//
// In each element: where the ray leaves it, by evaluations of the mapping alone (segments/segment.glsl); then light of the segment, from
// samples of the field (volume/volume_segment.glsl). Lanes do both together, each in its own element.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "tiles/hierarchy.glsl"
#include "picture/samples.glsl"
#include "picture/pixel_ray.glsl"
#include "volume/volume_state.glsl"

layout(set = 0, binding = 1, std430) buffer core_states_block { core_volume_state core_states[]; };
// Depth of what hides the volume, CORE_FAR where nothing does; only with core_has_depths. Depth where the ray is to wait, likewise.
layout(set = 0, binding = 2, std430) readonly buffer core_depths_block { elvis_real core_depths[]; };
layout(set = 0, binding = 6, std430) readonly buffer core_stops_block { elvis_real core_stops[]; };
layout(set = 0, binding = 3, std430) readonly buffer core_breakpoints_block { elvis_real core_breakpoints[]; };
layout(set = 0, binding = 4, std430) readonly buffer core_pieces_block { elvis_vec4 core_pieces[]; };
// Rays that this dispatch has moved, evaluations of mapping and field, of the mapping alone, segments, empty segments, steps,
// breakpoints, Newton failures.
layout(set = 0, binding = 5, std430) buffer core_counts_block { uint core_counts[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    // In the list of groups.
    uint core_first_group;
    uint core_first_element, core_n_elements;
    uint core_first_component, core_end_component;
    uint core_n_breakpoints;
    uint core_has_depths, core_has_stops;
    // Intervals where bounds say that density and colour are constant need no values.
    uint core_skips_by_range;
    uint core_zero;
    // The diagonal of the volume's bounds.
    float core_extent;
    // Of a channel; of the field's density and light with its value, at most; world length of steps.
    float core_tolerance, core_steepest, core_step;
};

#define CORE_CENTRE core_reference.xyz
#define CORE_GROUPS_BINDING 7
#include "tiles/ray_group.glsl"
#include "arithmetic/driver_limit.glsl"
#include "segments/segment.glsl"
#include "segments/traced_ray.glsl"
#include "segments/neighbour_walk.glsl"
#include "field/shown_model.glsl"
#include "segments/ray_sample.glsl"
#include "arithmetic/count.glsl"
#include "volume/transfer.glsl"
#include "volume/volume_constant.glsl"
#include "volume/volume_integrators.glsl"

// Elements of a ray in one dispatch, and iterations, with all loops inside below where drivers end them.
#define CORE_MOST_ELEMENTS 48u
#define CORE_WORK_LIMIT 800u
// Transmittance over the tolerance, below which nothing behind can be seen.
#define CORE_OPAQUE 0.125

#include "volume/volume_segment.glsl"

// Where the ray ends at an opaque surface, or waits at a transparent one.
struct core_ray_stop {
    elvis_real t;
    uint status;
};

core_ray_stop core_stop_of(uint pixel, elvis_real speed, elvis_real reference_distance) {
    elvis_real end = CORE_FAR, wait = CORE_FAR;
    if (core_has_depths != 0u) {
        end = core_depths[pixel] / speed - reference_distance;
    }
    if (core_has_stops != 0u) {
        wait = core_stops[pixel] / speed - reference_distance;
    }
    return core_ray_stop(min(end, wait), wait < end ? CORE_RAY_WAITS : CORE_RAY_ENDS);
}

// Where the segment begins in the walk's next element. What is too short to matter is the next one's.
elvis_real core_segment_from(core_traced_ray ray, bool is_met, inout core_walk walk) {
    const elvis_real gap = max(elvis_real(16) * ray.tolerance, elvis_real(CORE_WIDEST_GAP * core_extent) / ray.speed);
    const bool is_joined = walk.at - walk.done <= gap;
    walk.flags |= is_met && !is_joined && walk.done > walk.start ? CORE_FLAG_UNDECIDED : 0u;
    return is_joined ? walk.done : walk.at;
}

bool core_has_time(uint n_elements, uint work) { return n_elements < CORE_MOST_ELEMENTS && work < CORE_WORK_LIMIT; }

void main() {
    const uvec2 place = core_group_pixel(core_first_group, core_size.x);
    const bool is_pixel = place.x < core_size.x;
    const uint pixel = is_pixel ? place.y * core_size.x + place.x : 0u;
    const core_cut_column column = core_cut_begin(elvis_real(place.x));
    const core_traced_ray ray = core_traced_ray_of(core_pixel_ray(column, elvis_real(place.y)), elvis_real(core_extent));
    const core_ray_stop stop = core_stop_of(pixel, ray.speed, column.reference_distance);
    core_volume_state state = core_states[pixel];
    core_walk walk = core_walk_begin(state.walk, is_pixel, stop.t, stop.status);
    core_light light = state.light;
    core_held_piece held = core_hold_piece(0u);
    core_segment segment = core_no_segment();
    core_march_counts counts = core_march_counts(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    uint work = 0u;
    bool goes = core_walk_goes(walk);
    while (goes && core_has_time(counts.n_elements, work)) {
        while (goes && core_has_time(counts.n_elements, work)) {
            const uint work_before = work;
            const core_reach reach = core_walk_reach(ray, walk, segment);
            counts.n_mappings += segment.iterations;
            work += segment.iterations;
            const elvis_real from = core_segment_from(ray, reach.is_met, walk), until = min(reach.leave, stop.t);
            const bool has_segment = reach.is_met && from < until;
            const bool is_bounded =
                core_is_constant(core_range_along(segment, from, until), held) && has_segment && core_skips_by_range != 0u;
            core_findings findings = core_findings(is_bounded, true, false, false);
            const core_accuracy wanted = core_accuracy_along(ray.speed, walk.start, from, until, light);
            core_integral integral = core_integral_begin(from, has_segment && !is_bounded ? until : from, ray.speed, state.step);
            core_follower follower = core_follow_from(segment.anchor);
            core_aim(integral, wanted.enough, follower);
#if CORE_IS_EXACT
            // Where the ray leaves the mapping has been evaluated.
            if (core_is_open(integral.wants, findings)) {
                const core_ray_sample found =
                    core_sample_predicted(segment, core_integral_at(integral), follower.span, wanted.enough);
                counts.n_evaluations += 1u;
                findings.is_constant = core_tells_constant(found, follower.span, until - from, held);
                if (core_is_taken(found.status, findings)) {
                    core_integral_add(integral, light, found, wanted, held, work);
                    core_aim(integral, wanted.enough, follower);
                }
            }
#endif
            while (core_is_open(integral.wants, findings) && (work < CORE_WORK_LIMIT || !core_integral_may_stop(integral))) {
                // Until all lanes have what they need, so that what follows is done for all of them together.
                bool is_running = core_integral_wants_sample(integral);
                while (is_running) {
                    const core_ray_sample found = core_sample_step(ray, segment.element, segment.curvature, follower);
                    core_judge(found, findings, counts, walk.flags);
                    work += CORE_WORK_A_SAMPLE;
#if !CORE_IS_EXACT
                    if (findings.is_fresh && !findings.is_broken) {
                        findings.is_constant = core_tells_constant(found, follower.span, until - from, held);
                    }
#endif
                    if (core_is_taken(found.status, findings)) {
                        findings.is_fresh = false;
                        core_integral_add(integral, light, found, wanted, held, work);
                        core_aim(integral, wanted.enough, follower);
                    }
                    is_running = core_is_open(integral.wants, findings) && core_integral_wants_sample(integral) &&
                                 (work < CORE_WORK_LIMIT || !core_integral_may_stop(integral));
                    if (!is_running) {
                        break;
                    }
                }
                work = subgroupMax(work);
#if CORE_IS_EXACT
                if (core_is_open(integral.wants, findings)) {
                    core_integral_settle(integral, light, wanted, held, work);
                    core_aim(integral, wanted.enough, follower);
                }
#endif
                if (!core_is_open(integral.wants, findings)) {
                    break;
                }
            }
            core_add_simple(light, findings, held, (until - from) * ray.speed);
            counts.n_elements += 1u;
            counts.n_segments += has_segment ? 1u : 0u;
            counts.n_empty += findings.is_constant ? 1u : 0u;
            counts.n_steps += integral.n_steps;
            counts.n_breakpoints += integral.n_breakpoints;
            walk.flags |= has_segment && core_is_model_estimated(segment.element) ? CORE_FLAG_ESTIMATED : 0u;

            // On, in the same element if there was no time for all of it, unless the ray stops or nothing behind can be seen.
            const bool is_left_open = core_is_open(integral.wants, findings);
            state.step = is_left_open ? core_integral_step(integral) : CORE_FAR;
            walk.done = walk.needs_roughly ? walk.done : max(walk.done, is_left_open ? core_integral_done(integral) : until);
            const bool is_opaque = light.transmittance <= elvis_real(CORE_OPAQUE) * elvis_real(core_tolerance);
            const bool is_stopped = reach.is_met && reach.leave >= stop.t;
            if (!is_opaque && !is_stopped && !is_left_open) {
                core_walk_go_on(ray, segment, reach, from, walk);
            }
            walk.status = is_opaque ? CORE_RAY_ENDS : is_stopped && !is_left_open ? stop.status : walk.status;
            // Lanes wait for each other.
            work = work_before + subgroupMax(work - work_before);
            goes = core_walk_goes(walk);
            if (!goes || subgroupAny(core_walk_needs_help(walk))) {
                break;
            }
        }
        core_walk_help(ray, walk, segment);
        goes = core_walk_goes(walk);
        if (!goes) {
            break;
        }
    }
    const core_walk_state end = core_walk_end(walk);
    if (walk.is_mine) {
        core_states[pixel] = core_volume_state(end, state.step, light);
    }
    core_count(0u, uvec4(walk.is_mine ? 1u : 0u, counts.n_evaluations, counts.n_mappings, counts.n_segments));
    core_count(4u, uvec4(counts.n_empty, counts.n_steps, counts.n_breakpoints, counts.n_failures));
}
