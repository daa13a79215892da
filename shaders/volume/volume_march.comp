// Light along the rays of pixels, from element to element of one class (volume/volume_state.glsl).
//
// In each element: where the ray leaves it, by evaluations of the mapping alone (segments/segment.glsl); then samples of the field, as
// the integrator wants them, and its integral of what lies between. Lanes do both together, each in its own element.

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
#include "volume/transfer.glsl"
#include "volume/volume_light.glsl"
#include "volume/volume_constant.glsl"
#include "volume/volume_integrators.glsl"
#if CORE_INTEGRATOR == CORE_INTEGRATOR_EXACT
#include "volume/volume_exact.glsl"
#include "volume/volume_polynomials.glsl"
#elif CORE_INTEGRATOR == CORE_INTEGRATOR_CATEGORIES
#include "volume/volume_categories.glsl"
#elif CORE_INTEGRATOR == CORE_INTEGRATOR_ADAPTIVE_TRAPEZOID
#include "volume/volume_adaptive.glsl"
#else
#include "volume/volume_steps.glsl"
#endif

// Elements of a ray in one dispatch, and iterations, with all loops inside below where drivers end them.
#define CORE_MOST_ELEMENTS 48u
#define CORE_WORK_LIMIT 800u
#ifndef CORE_BEGINS_AT_END
#define CORE_BEGINS_AT_END 0
#define CORE_SETTLES 0
#endif
#ifndef CORE_WORK_A_SAMPLE
#define CORE_WORK_A_SAMPLE 1u
#endif
// Below this share nothing behind can be seen.
#define CORE_OPAQUE 0.125

void main() {
    const uvec2 place = core_group_pixel(core_first_group, core_size.x);
    const uint column = place.x, row = place.y;
    const bool is_pixel = column < core_size.x;
    const uint pixel = is_pixel ? row * core_size.x + column : 0u;
    core_volume_state state = core_states[pixel];
    const core_cut_column along = core_cut_begin(elvis_real(column));
    const core_ray pixel_ray = core_pixel_ray(along, elvis_real(row));
    const core_traced_ray ray = core_traced_ray_of(pixel_ray, elvis_real(core_extent));
    elvis_real end = CORE_FAR, stop = CORE_FAR;
    if (core_has_depths != 0u) {
        end = core_depths[pixel] / ray.speed - along.reference_distance;
    }
    if (core_has_stops != 0u) {
        stop = core_stops[pixel] / ray.speed - along.reference_distance;
    }
    const elvis_real to = min(end, stop);
    const uint status_at_end = stop < end ? CORE_RAY_WAITS : CORE_RAY_ENDS;

    uint flags = 0u;
    core_walk walk = core_walk(state.done, state.walk, state.start, state.start_element, state.element,
                                  is_pixel ? state.status : CORE_RAY_ENDS, 0u, false, false, false, false);
    bool is_mine;
    bool goes = core_walk_begin(walk, to, status_at_end, is_mine);
    elvis_real step = state.step;
    core_light light = core_light(state.red, state.green, state.blue, state.left, state.error);
    const elvis_real tolerance = elvis_real(core_tolerance);

    uint n_elements = 0u, n_evaluations = 0u, n_mappings = 0u, n_segments = 0u, n_empty = 0u, n_steps = 0u, n_breakpoints = 0u;
    uint n_failures = 0u, work = 0u;
    core_segment segment;
    segment.element = 0u;
    segment.next = segment.anchor = segment.x = segment.y = segment.z = elvis_real(0);
    segment.slope_x = segment.slope_y = segment.slope_z = elvis_real(0);
    segment.iterations = 0u;
    core_held_piece held = core_hold_piece(0u);
    // What few rays need stands behind the loop over elements, which ends for all lanes when one needs it: inside it would be gone through
    // in every element.
    while (goes && n_elements < CORE_MOST_ELEMENTS && work < CORE_WORK_LIMIT) {
        while (goes && n_elements < CORE_MOST_ELEMENTS && work < CORE_WORK_LIMIT) {
            n_elements += 1u;
            const uint work_before = work;
            const uint local = walk.element - core_first_element;
            const core_reach reach = core_walk_reach(ray, walk, segment);
            const bool is_met = reach.is_met;
            const elvis_real leave = reach.leave;
            flags |= reach.flags;
            n_mappings += segment.iterations;
            work += segment.iterations;
            // What is too short to matter is the next one's.
            const bool is_joined = walk.at - walk.done <= max(elvis_real(16) * ray.tolerance, elvis_real(CORE_WIDEST_GAP * core_extent) / ray.speed);
            flags |= is_met && !is_joined && walk.done > walk.start ? CORE_FLAG_UNDECIDED : 0u;
            const elvis_real from = is_joined ? walk.done : walk.at, until = min(leave, to);

            // What lies between.
            const bool has_segment = is_met && from < until;
            const bool is_constant = core_is_constant(core_range_along(segment, from, until), held) && has_segment && core_skips_by_range != 0u;
            if (is_constant) {
                core_add_constant(light, core_piece_of(held), (until - from) * ray.speed);
            }
            n_segments += has_segment ? 1u : 0u;
            n_empty += is_constant ? 1u : 0u;
            core_integral integral = core_integral_begin(from, has_segment && !is_constant ? until : from, ray.speed, step);
            const elvis_real ahead = max(elvis_real(core_extent) / ray.speed - (from - walk.start), until - from);
            const elvis_real enough = elvis_real(0.0625LF) * max(tolerance - light.error, elvis_real(0.0625LF) * tolerance) /
                                      (elvis_real(core_steepest) * (until - from) * ray.speed * max(light.left, elvis_real(1e-6LF)));
            core_follower follower = core_follow_from(segment.anchor, elvis_vec3(segment.x, segment.y, segment.z),
                                                      elvis_vec3(segment.slope_x, segment.slope_y, segment.slope_z));
            core_follow_to(follower, core_integral_at(integral));
            follower.span = core_integral_span(integral);
            follower.enough = enough;
            bool is_broken = false, is_no_number = false, is_fresh = true, is_dismissed = false;
#if CORE_BEGINS_AT_END
            // Where the ray leaves the mapping has been evaluated.
            if (integral.wants != CORE_WANTS_NOTHING) {
                const core_ray_sample result = core_sample_predicted(segment, core_integral_at(integral), follower.span, enough);
                n_evaluations += 1u;
                const elvis_real other = result.value + follower.span * result.slope, beyond = result.bend + result.error;
                const bool is_all = abs(follower.span) >= until - from && result.is_known && core_skips_by_range != 0u;
                is_dismissed =
                    is_all && core_is_constant(elvis_vec2(min(result.value, other) - beyond, max(result.value, other) + beyond), held);
                if (!is_dismissed && result.status == CORE_SAMPLE_FOUND) {
                    core_integral_add(integral, light, result.value, result.slope, result.error, result.bend, ray.speed, tolerance, ahead,
                                      held, work);
                    core_follow_to(follower, core_integral_at(integral));
                    follower.span = core_integral_span(integral);
                    follower.enough = enough;
                }
            }
#endif
            while (integral.wants != CORE_WANTS_NOTHING && !is_broken && !is_dismissed && (work < CORE_WORK_LIMIT || !core_integral_may_stop(integral))) {
                // Until all lanes have what they need, so that what follows is done for all of them together.
                bool is_running = core_integral_wants_sample(integral);
                while (is_running) {
                    work += CORE_WORK_A_SAMPLE;
                    const core_ray_sample result = core_sample_step(ray, local, segment.curvature, follower);
                    n_evaluations += 1u;
                    const bool is_nan = !result.is_finite, has_failed = !is_nan && result.status == CORE_SAMPLE_FAILED;
                    is_broken = is_nan || has_failed;
                    is_no_number = is_nan;
                    n_failures += has_failed ? 1u : 0u;
                    flags |= is_nan ? CORE_FLAG_NAN : has_failed ? CORE_FLAG_NEWTON_FAILURE : 0u;
#if !CORE_BEGINS_AT_END
                    // The first evaluation at an end of the segment may tell that there is nothing in all of it.
                    const bool is_all = is_fresh && abs(follower.span) >= until - from && result.is_known && !is_broken && core_skips_by_range != 0u;
                    if (is_all) {
                        const elvis_real other = result.value + follower.span * result.slope, beyond = result.bend + result.error;
                        is_dismissed = core_is_constant(elvis_vec2(min(result.value, other) - beyond, max(result.value, other) + beyond), held);
                    }
#endif
                    const bool is_found = !is_broken && !is_dismissed && result.status == CORE_SAMPLE_FOUND;
                    if (is_found) {
                        is_fresh = false;
                        core_integral_add(integral, light, result.value, result.slope, result.error, result.bend, ray.speed, tolerance,
                                          ahead, held, work);
                        core_follow_to(follower, core_integral_at(integral));
                        follower.span = core_integral_span(integral);
                        follower.enough = enough;
                    }
                    is_running = !is_broken && !is_dismissed && core_integral_wants_sample(integral) &&
                                 (work < CORE_WORK_LIMIT || !core_integral_may_stop(integral));
                    if (!is_running) {
                        break;
                    }
                }
                work = subgroupMax(work);
#if CORE_SETTLES
                if (!is_broken && !is_dismissed) {
                    core_integral_settle(integral, light, ray.speed, tolerance, ahead, held, work);
                    core_follow_to(follower, core_integral_at(integral));
                    follower.span = core_integral_span(integral);
                    follower.enough = enough;
                }
#endif
                if (integral.wants == CORE_WANTS_NOTHING || is_broken || is_dismissed) {
                    break;
                }
            }
            if (is_dismissed) {
                core_add_constant(light, core_piece_of(held), (until - from) * ray.speed);
            }
            n_empty += is_dismissed ? 1u : 0u;
            n_steps += integral.n_steps;
            n_breakpoints += integral.n_breakpoints;
            flags |= has_segment && core_is_model_estimated(local) ? CORE_FLAG_ESTIMATED : 0u;
            // What is no number hides all behind it, in a colour of its own.
            if (is_no_number) {
                core_add_light(light, elvis_vec3(1, 0, 1), elvis_real(0));
            }

            // Where to go on: in the same element, if there was no time for all of it.
            const bool is_left_open = integral.wants != CORE_WANTS_NOTHING && !is_broken && !is_dismissed;
            step = is_left_open ? core_integral_step(integral) : CORE_FAR;
            walk.done = walk.needs_roughly ? walk.done : max(walk.done, is_left_open ? core_integral_done(integral) : until);
            const bool is_opaque = light.left <= elvis_real(CORE_OPAQUE) * tolerance, is_stopped = is_met && leave >= to;
            const bool is_over = is_opaque || is_stopped || is_left_open;
            if (!is_over) {
                core_walk_go_on(ray, walk, segment, reach, from);
            }
            walk.status = is_opaque ? CORE_RAY_ENDS : is_stopped && !is_left_open ? status_at_end : walk.status;
            goes = core_walk_goes(walk);
            // Lanes wait for each other.
            work = work_before + subgroupMax(work - work_before);
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
    const bool is_cut_short = core_has_driver_given_up(core_zero);
    const bool seeks = walk.status == CORE_RAY_SEEKS;
    flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u;
    if (is_mine) {
        state.done = walk.done;
        state.step = step;
        state.walk = seeks ? CORE_FAR : walk.at;
        state.start = walk.start;
        state.start_element = walk.start_element;
        state.red = light.red;
        state.green = light.green;
        state.blue = light.blue;
        state.left = light.left;
        state.error = light.error;
        state.element = seeks ? CORE_NO_ELEMENT : walk.element;
        state.status = is_cut_short ? CORE_RAY_ENDS : walk.status;
        state.flags |= flags;
        core_states[pixel] = state;
    }
    const uint all_moved = subgroupAdd(is_mine ? 1u : 0u), all_evaluations = subgroupAdd(n_evaluations);
    const uint all_mappings = subgroupAdd(n_mappings), all_segments = subgroupAdd(n_segments), all_empty = subgroupAdd(n_empty);
    const uint all_steps = subgroupAdd(n_steps), all_breakpoints = subgroupAdd(n_breakpoints), all_failures = subgroupAdd(n_failures);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_moved);
        atomicAdd(core_counts[1], all_evaluations);
        atomicAdd(core_counts[2], all_mappings);
        atomicAdd(core_counts[3], all_segments);
        atomicAdd(core_counts[4], all_empty);
        atomicAdd(core_counts[5], all_steps);
        atomicAdd(core_counts[6], all_breakpoints);
        atomicAdd(core_counts[7], all_failures);
    }
}
