// The first point of each pixel's ray at which the field takes one of the isovalues, in the elements of one class.
//
// The list of a tile of pixels (tiles/ray_tiles.comp) names the octants of elements that can hold an isovalue, in the order of
// depth, so that the search ends at the first octant behind the crossing found. A work group is a few rows of a tile, and takes over what
// these can meet (isosurface/group_octants.glsl).
//
// A ray is cut down to what an octant's linear models of mapping and field leave (isosurface/octant.glsl). Then one interval after the
// other is looked at, front to back (isosurface/ray_interval.glsl). One evaluation bounds the field over the interval by a line and an
// error, which tells
//
//   that no isovalue is taken     the interval is done: that is certified, as far as the bounds are
//   where one may be taken        the interval is cut down to there; before, none is: the interval Newton method (R. E. Moore, Interval
//                                 Analysis, 1966), which converges quadratically where the field is steep
//   or little                     the interval is halved
//
// until the interval is short. Then the line's root is the crossing, if the field surely takes the isovalue within the error. If that
// cannot be told the pixel is undecided: isosurface/interval_bounds.glsl, interval_root.glsl and octant_search.glsl.
//
// One evaluation of mapping and field an iteration, whatever element and interval a lane is at, so that lanes do not wait for each other.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "tiles/ray_tiles.glsl"
#include "tiles/hierarchy.glsl"
#include "picture/samples.glsl"
#include "element/place.glsl"
#include "arithmetic/finite.glsl"
#include "picture/pixel_ray.glsl"
#define CORE_LAST_BINDING 11
#include "isosurface/isosurface_bindings.glsl"
#include "isosurface/isosurface_blur.glsl"
#include "arithmetic/count.glsl"

layout(set = 0, binding = 5) CORE_READ_WORDS(core_tiles);
#if CORE_HAS_MASK
// Of pixels that are drawn; zero of others.
layout(set = 0, binding = 12) CORE_READ_WORDS(core_mask);
bool core_is_chosen(uint pixel) { return CORE_WORD(core_mask, pixel) != 0u; }
#else
bool core_is_chosen(uint pixel) { return true; }
#endif
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_tiles_per_row;
    uint core_first_listed;
    // Counted from 1; 0 is no surface.
    uint core_surface_number;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_n_clips;
    uint core_has_beyond;
    // 0: from the eye on.
    uint core_round;
    // The diagonal of the volume's bounds.
    float core_extent;
};

#define CORE_LISTED_BINDING 10
#include "tiles/listed_tile.glsl"
#include "isosurface/isovalues.glsl"
#include "picture/look_beyond.glsl"
#include "picture/distrust_column.glsl"
#include "element/element_frame.glsl"
#include "field/shown_model.glsl"
#include "isosurface/ray_interval.glsl"
#include "isosurface/group_octants.glsl"
#include "isosurface/octant_descent.glsl"
#include "isosurface/nearest_crossing.glsl"
#include "isosurface/kept_part.glsl"
#include "isosurface/interval_bounds.glsl"
#include "isosurface/interval_root.glsl"
#include "isosurface/octant_search.glsl"

// Iterations of one pixel: all pixels of an invocation stay below where drivers end loops. Those that descend draw one.
#if CORE_DESCENDS
#define CORE_WORK_LIMIT 24000u
#else
#define CORE_WORK_LIMIT 8000u
#endif

// The root, as a crossing of the ray.
core_nearest_crossing core_found_at(const core_evaluation evaluation, const core_root root) {
    const core_linear_root candidate = evaluation.candidate;
    return core_nearest_crossing(evaluation.middle + candidate.s, candidate.half_width, evaluation.interval.slope > elvis_real(0),
                                 root.xi.x, root.xi.y, root.xi.z, candidate.isovalue, root.gradient.x, root.gradient.y, root.gradient.z,
                                 root.bend, evaluation.element, elvis_fetch_core_elements(evaluation.element, 0u), root.is_surely_inside);
}

// Flag of a pixel in which rounding may have led the crossing away.
uint core_blur_of(const core_nearest_crossing nearest, const core_ray ray, elvis_real stretch) {
#if ELVIS_REAL_IS_DOUBLE
    // Rounding alone: the crossing's own width is that of the interval in which it was found. In single precision bounds of rounding say
    // too little: projection would be as uncertain, and less exact.
    const bool is_hit = nearest.element != CORE_NO_ELEMENT;
    const elvis_vec3 xi = elvis_vec3(nearest.xi_x, nearest.xi_y, nearest.xi_z);
    const elvis_vec3 gradient = elvis_vec3(nearest.gradient_x, nearest.gradient_y, nearest.gradient_z);
    const elvis_real width = core_shown_rounding(is_hit ? nearest.element : 0u, xi) / abs(dot(gradient, ray.direction));
    const bool is_blurred = is_hit && CORE_ROOT_SHARE * width * stretch > CORE_DEPTH_TOLERANCE * elvis_real(core_extent);
    return is_blurred ? CORE_FLAG_ISOSURFACE_UNDECIDED : 0u;
#else
    return 0u;
#endif
}

struct core_interval_counts {
    uint n_evaluations, n_excluded, n_outside, n_undecided, n_crossings;
};

// Evaluates the interval once. Accepts the root as a crossing if it is proven, exact, in the element and ahead of the ray. Then chooses
// the next interval. Returns flags of the pixel.
uint core_search_step(core_ray ray, const core_last_crossing last, inout core_interval_search search, inout core_nearest_crossing nearest,
                      inout core_interval_counts counts) {
    const bool is_active = search.element != CORE_NO_ELEMENT;
    search.used += 1u;
    const core_evaluation evaluation = core_evaluate_at(ray, search);
    const core_root root = core_root_of(evaluation, search);
    const core_verdict verdict = core_judge_interval(evaluation, root, search);
    const core_nearest_crossing found = core_found_at(evaluation, root);
    const bool is_crossing = verdict.is_finished_root && root.is_inside && !core_is_last_again(last, found);
    const bool is_hit = is_crossing && core_is_ahead(ray, found.t, found.slack);
    const bool is_doubtful = is_crossing && core_is_ahead_doubtful(ray, found.t, found.slack);
    core_nearest_take(is_hit, found, nearest);
    const bool is_open = core_interval_search_next(evaluation, verdict, is_hit, core_nearest_end(nearest), search);
    counts.n_evaluations += is_active ? 1u : 0u;
    counts.n_outside += verdict.is_empty ? 1u : 0u;
    counts.n_excluded += verdict.is_excluded ? 1u : 0u;
    counts.n_crossings += verdict.is_finished_root ? 1u : 0u;
    counts.n_undecided += is_open ? 1u : 0u;
    const uint open_flag = evaluation.is_finite ? CORE_FLAG_ISOSURFACE_UNDECIDED : CORE_FLAG_NAN;
    return (is_active && core_is_model_estimated(evaluation.element) ? CORE_FLAG_ESTIMATED : 0u) | (is_open ? open_flag : 0u) |
           (is_doubtful ? CORE_FLAG_UNDECIDED_IN_FRONT : 0u);
}

// The nearest crossing of a ray. Returns flags of the pixel.
uint core_search_ray(core_ray ray, const core_last_crossing last, core_octant_descent descent,
                     inout core_nearest_crossing nearest, inout core_interval_counts counts) {
    uint work = 0u, flags = 0u;
    core_interval_search search = core_no_search();
    while (descent.entry < descent.n_entries && work < CORE_WORK_LIMIT) {
        core_look_ahead(ray, float(core_nearest_end(nearest)), descent);
        while ((search.element != CORE_NO_ELEMENT || core_has_octants_ahead(descent)) && work < CORE_WORK_LIMIT) {
            work += 1u;
            while (search.element == CORE_NO_ELEMENT && core_has_octants_ahead(descent) && work < CORE_WORK_LIMIT) {
                work += 1u;
                const float end_t = float(core_nearest_end(nearest));
                const uint index = core_seek_octant(ray, end_t, descent);
                if (index != CORE_NO_NODE) {
                    const core_octant octant = core_fetch_octant(index);
                    flags |= core_interval_search_begin(octant, core_octant_span_of(octant, ray, end_t), search);
                }
                if (search.element != CORE_NO_ELEMENT || !core_has_octants_ahead(descent)) {
                    break;
                }
            }
            flags |= core_search_step(ray, last, search, nearest, counts);
            if (search.element == CORE_NO_ELEMENT && !core_has_octants_ahead(descent)) {
                break;
            }
        }
        if (descent.entry >= descent.n_entries) {
            break;
        }
    }
    const bool is_cut_short = search.element != CORE_NO_ELEMENT || core_has_octants_ahead(descent) || descent.entry < descent.n_entries;
    return flags | (is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u);
}

void main() {
    const uint tile = core_listed_tile(core_first_listed);
    const uint first_column = tile % core_tiles_per_row * CORE_TILE_WIDTH, column = first_column + gl_LocalInvocationID.x;
    const uint first_row = tile / core_tiles_per_row * CORE_TILE_HEIGHT + gl_WorkGroupID.y * CORE_ROWS;
    const uint list = tile * CORE_TILE_STRIDE;
    core_begin_isovalues();
    const uint n_listed = core_take_octants(list, CORE_WORD(core_tiles, list) & ~CORE_TILE_INNER, first_column, first_row);
    const uint end_row = n_listed > 0u && column < core_size.x ? min(first_row + CORE_ROWS, core_size.y) : first_row;
    const core_cut_column along = core_cut_begin(elvis_real(column));
    core_interval_counts counts = core_interval_counts(0u, 0u, 0u, 0u, 0u);
    uint row = first_row;
    while (row < end_row) {
        core_ray ray = core_pixel_ray(along, elvis_real(row));
        const uint pixel = row * core_size.x + column;
        const bool is_wanted = core_look_beyond(pixel, ray) && core_is_chosen(pixel);
        const elvis_real stretch = length(ray.direction);
        core_nearest_crossing nearest = core_nearest_begin(pixel, stretch, along.reference_distance);
        const core_last_crossing last = core_last_crossing_of(pixel, ray.least_t);
        const uint n_entries = core_keep_part(ray, nearest) && is_wanted ? n_listed : 0u;
        uint flags = core_search_ray(ray, last, core_octant_descent(n_listed, n_entries, 0u, 0u, 0u, 0u), nearest, counts);
        flags |= core_blur_of(nearest, ray, stretch) | core_nearest_store(nearest, pixel, ray, stretch, along.reference_distance);
        if (flags != 0u) {
            core_marks[pixel].flags |= flags;
        }
        row += 1u;
        if (row >= end_row) {
            break;
        }
    }
    core_distrust_column(column, first_row, row, end_row, core_surface_number >> 31);
    if (end_row > first_row) {
        core_count(0u, counts.n_evaluations);
        core_count(1u, counts.n_excluded);
        core_count(2u, counts.n_outside);
        core_count(3u, counts.n_undecided);
        core_count(4u, counts.n_crossings);
    }
}
