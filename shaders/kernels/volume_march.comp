// Light along the rays of pixels, from element to element of one class (library/volume_state.glsl).
//
// In each element: where the ray leaves it, by evaluations of the mapping alone (library/ray_part.glsl); then samples of the field, as
// the integrator wants them, and its integral of what lies between. Lanes do both together, each in its own element.
//
// Loops end with a break where their condition has become false, and rare code stands in an if, not in a loop of one turn: lavapipe
// leaves a loop only behind its body, so that one that is tested at its head goes through it once more than it is taken, lanes off.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "library/precision.glsl"
#include "library/cut_frame.glsl"
#include "library/hierarchy.glsl"
#include "library/samples.glsl"
#include "library/pixel_ray.glsl"
#include "library/volume_state.glsl"

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
    uint core_first_row;
    uint core_first_element, core_n_elements;
    uint core_first_component, core_end_component;
    uint core_n_breakpoints;
    uint core_has_depths, core_has_stops;
    // Parts of rays where bounds say that density and colour are constant need no values.
    uint core_skips_by_range;
    uint core_zero;
    // The diagonal of the volume's bounds.
    float core_extent;
    // Of a channel; of the field's density and light with its value, at most; world length of steps.
    float core_tolerance, core_steepest, core_step;
};

#define CORE_CENTRE core_reference.xyz
#include "library/driver_limit.glsl"
#include "library/ray_part.glsl"
#include "library/walk_ray.glsl"
#include "library/chain_walk.glsl"
#include "library/shown_model.glsl"
#include "library/ray_sample.glsl"
#include "library/transfer.glsl"
#include "library/volume_light.glsl"
#include "library/volume_level.glsl"
#include "library/volume_integrators.glsl"
#if CORE_INTEGRATOR == CORE_INTEGRATOR_EXACT
#include "library/volume_exact.glsl"
#include "library/volume_polynomials.glsl"
#elif CORE_INTEGRATOR == CORE_INTEGRATOR_CATEGORIES
#include "library/volume_categories.glsl"
#elif CORE_INTEGRATOR == CORE_INTEGRATOR_ADAPTIVE_TRAPEZOID
#include "library/volume_adaptive.glsl"
#else
#include "library/volume_steps.glsl"
#endif

// Elements of a ray in one dispatch, and turns, with all loops inside below where drivers end them.
#define CORE_MOST_ELEMENTS 48u
#define CORE_WORK_LIMIT 800u
#ifndef CORE_BEGINS_AT_END
#define CORE_BEGINS_AT_END 0
#define CORE_SETTLES 0
#endif
#ifndef CORE_WORK_A_SAMPLE
#define CORE_WORK_A_SAMPLE 1u
#endif
// Parts on end that are too short to matter, before the element around the ray is looked for.
#define CORE_MOST_GRAZES 4u
// Over the volume's size: gaps between elements of a chain that are rounding's.
#define CORE_WIDEST_GAP 1e-6
// Below this share nothing behind can be seen.
#define CORE_OPAQUE 0.125

void main() {
    const uint column = gl_GlobalInvocationID.x, row = core_first_row + gl_WorkGroupID.y;
    const bool is_pixel = column < core_size.x && row < core_size.y;
    const uint pixel = is_pixel ? row * core_size.x + column : 0u;
    core_volume_state state = core_states[pixel];
    const core_cut_column along = core_cut_begin(elvis_real(column));
    const core_ray pixel_ray = core_pixel_ray(along, elvis_real(row));
    const core_walk_ray ray = core_walk_ray_of(pixel_ray, elvis_real(core_extent));
    elvis_real end = CORE_FAR, stop = CORE_FAR;
    for (uint turn = 0u; turn < core_has_depths; ++turn) {
        end = core_depths[pixel] / ray.speed - along.reference_distance;
    }
    for (uint turn = 0u; turn < core_has_stops; ++turn) {
        stop = core_stops[pixel] / ray.speed - along.reference_distance;
    }
    const elvis_real to = min(end, stop);
    const uint status_at_end = stop < end ? CORE_RAY_WAITS : CORE_RAY_ENDS;

    uint element = state.element, status = is_pixel ? state.status : CORE_RAY_ENDS, flags = 0u;
    const bool is_without = status == CORE_RAY_HAS_SOUGHT && element == CORE_NO_ELEMENT;
    const bool is_own = element >= core_first_element && element - core_first_element < core_n_elements;
    const bool is_mine = is_without || ((status == CORE_RAY_HAS_SOUGHT || status == CORE_RAY_GOES) && is_own);
    const bool begins = is_mine && status == CORE_RAY_HAS_SOUGHT && !is_without;
    elvis_real chain = state.chain, done = state.done, step = state.step;
    const elvis_real start = begins ? chain : state.start;
    const uint start_element = begins ? element : state.start_element;
    status = is_without ? CORE_RAY_ENDS : is_mine && chain >= to ? status_at_end : begins ? CORE_RAY_GOES : status;
    core_light light = core_light(state.red, state.green, state.blue, state.left, state.error);
    const elvis_real tolerance = elvis_real(core_tolerance);

    uint n_elements = 0u, n_evaluations = 0u, n_mappings = 0u, n_segments = 0u, n_empty = 0u, n_steps = 0u, n_breakpoints = 0u;
    // How often on end the element was not met where it was to be.
    uint n_failures = 0u, work = 0u, n_lost = 0u;
    core_part part;
    part.element = 0u;
    part.next = part.anchor = part.x = part.y = part.z = elvis_real(0);
    part.slope_x = part.slope_y = part.slope_z = elvis_real(0);
    part.turns = 0u;
    core_held_piece held = core_hold_piece(0u);
    bool goes = is_mine && status == CORE_RAY_GOES;
    // What few rays need stands behind the loop over elements, which ends for all lanes when one needs it: inside it would be gone through
    // in every element.
    bool is_rough = false, is_lost = false, has_part = false;
    while (goes && n_elements < CORE_MOST_ELEMENTS && work < CORE_WORK_LIMIT) {
        while (goes && n_elements < CORE_MOST_ELEMENTS && work < CORE_WORK_LIMIT) {
            n_elements += 1u;
            const uint work_before = work;
            const uint local = element - core_first_element;
            // Where the ray leaves.
            uint ending = CORE_PART_FOUND;
            if (!has_part) {
                const bool is_possible = core_part_begin(ray, local, chain, chain + ray.reach, true, part);
                ending = is_possible ? CORE_PART_OPEN : CORE_PART_NONE;
            }
            while (ending == CORE_PART_OPEN) {
                ending = core_part_turn(ray, true, part);
                n_mappings += 1u;
                work += 1u;
                if (ending != CORE_PART_OPEN) {
                    break;
                }
            }
            is_rough = part.has_failed && !has_part;
            has_part = false;
            // Where a ray grazes a face, elements on both sides find it at points farther apart than those of others.
            const elvis_real gap = part.enter - chain - part.enter_error;
            const bool is_met = ending == CORE_PART_FOUND && !is_rough && gap <= elvis_real(CORE_WIDEST_GAP * core_extent) / ray.speed;
            const bool is_estimated = is_met && part.is_estimated;
            flags |= is_estimated ? CORE_FLAG_ESTIMATED : 0u;
            const elvis_real leave = is_met ? max(part.leave, chain) : chain;
            // What is too short to matter is the next one's.
            const bool is_joined = chain - done <= max(elvis_real(16) * ray.tolerance, elvis_real(CORE_WIDEST_GAP * core_extent) / ray.speed);
            flags |= is_met && !is_joined && done > start ? CORE_FLAG_UNDECIDED : 0u;
            const elvis_real from = is_joined ? done : chain, until = min(leave, to);

            // What lies between.
            const bool has_segment = is_met && from < until;
            const bool is_level = core_is_level(core_level_range(part, from, until), held) && has_segment && core_skips_by_range != 0u;
            if (is_level) {
                core_add_level(light, core_piece_of(held), (until - from) * ray.speed);
            }
            n_segments += has_segment ? 1u : 0u;
            n_empty += is_level ? 1u : 0u;
            core_integral integral = core_integral_begin(from, has_segment && !is_level ? until : from, ray.speed, step);
            const elvis_real ahead = max(elvis_real(core_extent) / ray.speed - (from - start), until - from);
            const elvis_real enough = elvis_real(0.0625LF) * max(tolerance - light.error, elvis_real(0.0625LF) * tolerance) /
                                      (elvis_real(core_steepest) * (until - from) * ray.speed * max(light.left, elvis_real(1e-6LF)));
            core_follower follower;
            follower.known = part.anchor;
            follower.known_x = part.x;
            follower.known_y = part.y;
            follower.known_z = part.z;
            follower.slope_x = part.slope_x;
            follower.slope_y = part.slope_y;
            follower.slope_z = part.slope_z;
            core_follow_to(follower, core_integral_at(integral));
            follower.span = core_integral_span(integral);
            follower.enough = enough;
            bool is_broken = false, is_no_number = false, is_fresh = true, is_dismissed = false;
#if CORE_BEGINS_AT_END
            // Where the ray leaves the mapping has been evaluated.
            if (integral.wants != CORE_WANTS_NOTHING) {
                const core_ray_sample result = core_sample_predicted(part, core_integral_at(integral), follower.span, enough);
                n_evaluations += 1u;
                const elvis_real other = result.value + follower.span * result.slope, beyond = result.bend + result.error;
                const bool is_all = abs(follower.span) >= until - from && result.is_known && core_skips_by_range != 0u;
                is_dismissed =
                    is_all && core_is_level(elvis_vec2(min(result.value, other) - beyond, max(result.value, other) + beyond), held);
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
                    const core_ray_sample result = core_sample_step(ray, local, part.curvature, follower);
                    n_evaluations += 1u;
                    const bool is_nan = !result.is_finite, has_failed = !is_nan && result.status == CORE_SAMPLE_FAILED;
                    is_broken = is_nan || has_failed;
                    is_no_number = is_nan;
                    n_failures += has_failed ? 1u : 0u;
                    flags |= is_nan ? CORE_FLAG_NAN : has_failed ? CORE_FLAG_NEWTON_FAILURE : 0u;
#if !CORE_BEGINS_AT_END
                    // The first evaluation at an end of the part may tell that there is nothing in all of it.
                    const bool is_all = is_fresh && abs(follower.span) >= until - from && result.is_known && !is_broken && core_skips_by_range != 0u;
                    if (is_all) {
                        const elvis_real other = result.value + follower.span * result.slope, beyond = result.bend + result.error;
                        is_dismissed = core_is_level(elvis_vec2(min(result.value, other) - beyond, max(result.value, other) + beyond), held);
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
                core_add_level(light, core_piece_of(held), (until - from) * ray.speed);
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
            done = is_rough ? done : max(done, is_left_open ? core_integral_done(integral) : until);
            const bool is_opaque = light.left <= elvis_real(CORE_OPAQUE) * tolerance, is_stopped = is_met && leave >= to;
            const bool is_over = is_opaque || is_stopped || is_left_open;
            const bool stays = is_over || is_rough;
            chain = stays ? chain : leave;
            const uint next = elvis_fetch_core_links(local, uint(max(part.leave_face, 0)));
            // Elements on both sides of a face that the ray grazes may hand it to and fro.
            const bool is_stuck = leave - from <= elvis_real(4) * ray.tolerance;
            is_lost = !stays && (!is_met || part.leave_face < 0 || (is_stuck && n_lost >= CORE_MOST_GRAZES));
            n_lost = is_rough ? n_lost : is_lost || is_stuck ? n_lost + 1u : 0u;
            element = stays || is_lost ? element : next;
            status = is_opaque                                ? CORE_RAY_ENDS
                     : is_left_open || is_rough || is_lost    ? CORE_RAY_GOES
                     : is_stopped                             ? status_at_end
                     : next == CORE_NO_LINK                   ? CORE_RAY_SEEKS
                                                              : CORE_RAY_GOES;
            goes = status == CORE_RAY_GOES && element >= core_first_element && element - core_first_element < core_n_elements;
            // Lanes wait for each other.
            work = work_before + subgroupMax(work - work_before);
            const bool is_interrupted = subgroupAny(is_rough || is_lost);
            if (!goes || is_interrupted) {
                break;
            }
        }
        if (is_rough) {
            core_leave_roughly(ray, chain, part);
            flags |= CORE_FLAG_UNDECIDED;
            has_part = true;
        }
        if (is_lost) {
            const elvis_real probe = chain + elvis_real(4) * exp2(float(min(n_lost - 1u, 30u))) * ray.tolerance;
            uint other;
            const uint found = core_find_around(ray, element - core_first_element, probe, other);
            element = found != CORE_NO_ELEMENT ? core_first_element + found : other;
            chain = probe;
            status = element == CORE_NO_LINK ? CORE_RAY_SEEKS : CORE_RAY_GOES;
            goes = status == CORE_RAY_GOES && element >= core_first_element && element - core_first_element < core_n_elements;
        }
        is_rough = is_lost = false;
        if (!goes) {
            break;
        }
    }
    const bool is_cut_short = core_has_driver_given_up(core_zero);
    const bool seeks = status == CORE_RAY_SEEKS;
    flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u;
    if (is_mine) {
        state.done = done;
        state.step = step;
        state.chain = seeks ? CORE_FAR : chain;
        state.start = start;
        state.start_element = start_element;
        state.red = light.red;
        state.green = light.green;
        state.blue = light.blue;
        state.left = light.left;
        state.error = light.error;
        state.element = seeks ? CORE_NO_ELEMENT : element;
        state.status = is_cut_short ? CORE_RAY_ENDS : status;
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
