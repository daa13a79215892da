// Light along the rays of pixels, from element to element of one class (volume/volume_state.glsl).
//
// In each element: where the ray leaves it, by evaluations of the mapping alone (segments/segment.glsl); then light of the segment, from
// samples of the field (volume/volume_segment.glsl). Lanes do both together, each in its own element.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "tiles/hierarchy.glsl"
#include "picture/samples.glsl"
#include "picture/pixel_ray.glsl"
#include "volume/volume_state.glsl"

layout(set = 0, binding = 1, std430) buffer core_states_block { core_volume_state core_states[]; };
// Depth of what hides the volume, CORE_FAR where nothing does; only with core_has_depths. Depth where the ray is to wait, likewise.
layout(set = 0, binding = 2) CORE_READ_REALS(core_depths);
layout(set = 0, binding = 6) CORE_READ_REALS(core_stops);
layout(set = 0, binding = 3) CORE_READ_REALS(core_breakpoints);
layout(set = 0, binding = 4) CORE_READ_ROWS(core_pieces);
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
    // The diagonal of the volume's bounds; what its positions are off before any of it is evaluated.
    float core_extent, core_data_error;
    // Of a channel; of the field's density and light with its value, at most; world length of steps.
    float core_tolerance, core_steepest, core_step_length;
};

#define CORE_CENTRE core_reference.xyz
#define CORE_GROUPS_BINDING 7
#include "tiles/listed_group.glsl"
#include "arithmetic/driver_limit.glsl"
// Where elements are more curved, and nothing is proven at a point of them, segments are estimated.
#define CORE_ASSUMED_CURVATURE elvis_real(16)
#define CORE_CERTAIN_ITERATIONS 640u
#define CORE_SEGMENT_ITERATIONS 704u
// In double precision, the registers of graphics cards do not hold it.
#if CORE_HAS_CURVED && (CORE_READS_TEXELS || !ELVIS_REAL_IS_DOUBLE)
#define CORE_REMEMBERS_ENTRY 1
#endif
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
        end = CORE_REAL(core_depths, pixel) / speed - reference_distance;
    }
    if (core_has_stops != 0u) {
        wait = CORE_REAL(core_stops, pixel) / speed - reference_distance;
    }
    return core_ray_stop(min(end, wait), wait < end ? CORE_RAY_WAITS : CORE_RAY_ENDS);
}

// Where the segment begins in the element that the walk is in. A gap that is too small to matter is added to it.
elvis_real core_segment_from(core_traced_ray ray, bool is_met, inout core_walk walk) {
    const elvis_real gap = max(elvis_real(16) * ray.tolerance, elvis_real(CORE_WIDEST_GAP * core_extent) / ray.speed);
    const bool is_joined = walk.at - walk.done <= gap;
    walk.flags |= is_met && !is_joined && walk.done > walk.start ? CORE_FLAG_UNDECIDED : 0u;
    return is_joined ? walk.done : walk.at;
}

// Where the ray leaves roughly is not known in the next dispatch: it would be looked for again.
bool core_has_time(const core_march march, const core_walk walk) {
    return (march.n_elements < CORE_MOST_ELEMENTS && march.work < CORE_WORK_LIMIT) || walk.has_segment;
}

void main() {
    const uvec2 place = core_group_pixel(core_first_group, core_size.x);
    const bool is_pixel = place.x < core_size.x && place.y < core_size.y;
    const uint pixel = is_pixel ? place.y * core_size.x + place.x : 0u;
    const core_cut_column column = core_cut_begin(elvis_real(place.x));
    const core_traced_ray ray = core_traced_ray_of(core_pixel_ray(column, elvis_real(place.y)), elvis_real(core_extent), elvis_real(core_data_error));
    const core_ray_stop stop = core_stop_of(pixel, ray.speed, column.reference_distance);
    const core_volume_state state = core_states[pixel];
    core_walk walk = core_walk_begin(state.walk, is_pixel, stop.t, stop.status);
    core_march march = core_march(state.light, core_load_piece(0u), state.step, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    core_segment segment = core_no_segment();
    bool goes = core_walk_goes_here(walk);
    while (goes && core_has_time(march, walk)) {
        while (goes && core_has_time(march, walk)) {
            const uint work_before = march.work;
            const core_passage passage = core_walk_pass(ray, walk, segment);
            march.n_elements += 1u;
            march.n_mappings += segment.iterations;
            march.work += segment.iterations;
            const elvis_real from = core_segment_from(ray, passage.is_met, walk), until = min(passage.leave, stop.t);
            const core_integrated integrated =
                core_add_segment(ray, segment, walk.start, from, until, passage.is_met && from < until, march);
            walk.done = walk.needs_roughly ? walk.done : max(walk.done, integrated.until);

            // On, unless the ray stops or nothing behind can be seen; in the same element if there was no time for all of it.
            const bool is_opaque = march.light.transmittance <= elvis_real(CORE_OPAQUE) * elvis_real(core_tolerance);
            const bool is_stopped = passage.is_met && passage.leave >= stop.t;
            if (!is_opaque && !is_stopped && !integrated.is_left_open) {
                core_walk_go_on(ray, segment.leave_face, passage, from, walk);
            }
            walk.status = is_opaque ? CORE_RAY_ENDS : is_stopped && !integrated.is_left_open ? stop.status : walk.status;
            // Lanes wait for each other.
            march.work = work_before + subgroupMax(march.work - work_before);
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
    walk.flags |= march.flags;
    const core_walk_state end = core_walk_end(walk);
    if (walk.is_mine) {
        core_states[pixel] = core_volume_state(end, march.step, march.light);
    }
    core_count(0u, uvec4(walk.is_mine ? 1u : 0u, march.n_evaluations, march.n_mappings, march.n_segments));
    core_count(4u, uvec4(march.n_empty, march.n_steps, march.n_breakpoints, march.n_failures));
}
