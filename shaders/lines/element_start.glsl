// Where in an element the search begins: what the linearized mapping (element/linearization.glsl) predicts for a pixel's part of the
// surface.

#include "element/linearization.glsl"
#if CORE_STRONGLY_BENT
#include "lines/shown_part.glsl"

// Begins in the part of an element that the pixel can show, if there is any.
void core_begin_part(uint element, core_cut_square corners, elvis_vec3 normal, inout core_line_search search) {
    const core_shown_part part = core_find_part(element, corners, normal);
    search.work += part.n_evaluations;
    search.n_evaluations += part.n_evaluations;
    if (core_is_empty(part)) {
        search.item = CORE_NO_ITEM;
    } else if (part.is_known) {
        const elvis_vec3 middle = elvis_real(0.5LF) * (part.lower + part.upper);
        core_begin_element(search, middle);
        search.part_x = middle.x;
        search.part_y = middle.y;
        search.part_z = middle.z;
        search.part_half_side = elvis_real(0.5LF) * core_max_norm(part.upper - part.lower) + elvis_real(4) * CORE_ROUNDOFF;
    }
}
#endif

// Whether the linearized mapping alone says that all of the pixel's part of the surface lies outside. `start`: the prediction for its
// middle; `extent`: the maximum norm of the corners' offsets from it.
bool core_is_far_outside(elvis_vec3 start, elvis_real extent, elvis_real curvature) {
    // It keeps this many digits of coordinates in the element.
    const elvis_real start_error = elvis_real(1e-2LF);
    const elvis_vec3 from_centroid = abs(start - CORE_CENTROID);
    const elvis_real step = max(max(from_centroid.x, from_centroid.y), from_centroid.z) + extent;
    return core_excess(start.x, start.y, start.z) >
           CORE_CONSTRAINT_NORM * (core_prediction_error_within(curvature, step, CORE_EXTENT) + extent + start_error);
}

elvis_vec3 core_corner_offset(core_linearization linearization, elvis_vec3 corner, elvis_vec3 start) {
    return abs(elvis_vec3(core_linear_inverse(linearization, vec3(corner))) - start);
}

// The corners, moved away from `middle` so that they are `room` times as far.
core_cut_square core_widened(core_cut_square corners, elvis_vec3 middle, elvis_real room) {
    core_cut_square wide = corners;
    wide.corner0 = middle + room * (corners.corner0 - middle);
    wide.corner1 = middle + room * (corners.corner1 - middle);
    wide.corner2 = middle + room * (corners.corner2 - middle);
    wide.corner3 = middle + room * (corners.corner3 - middle);
    return wide;
}

// Selects an element unless it lies elsewhere. `corners` around `middle`: the pixel's part of the surface, which has this normal and
// reaches at most `room` times as far; infinitely far if that is zero.
void core_select_element(uint element, core_cut_square corners, elvis_vec3 middle, elvis_vec3 normal, elvis_real room,
                         inout core_line_search search) {
    const core_linearization linearization = core_fetch_linearization(element);
    const elvis_vec3 target = core_reference.xyz - elvis_origin(element) + middle;
    const bool is_linearized = linearization.exponents != 0u && corners.all_hit;
    const elvis_vec3 start = is_linearized ? elvis_vec3(core_linear_inverse(linearization, vec3(target))) : CORE_CENTROID;
    const elvis_vec3 shift = target - middle;
    const elvis_vec3 reach = max(max(core_corner_offset(linearization, shift + corners.corner0, start),
                                     core_corner_offset(linearization, shift + corners.corner1, start)),
                                 max(core_corner_offset(linearization, shift + corners.corner2, start),
                                     core_corner_offset(linearization, shift + corners.corner3, start)));
    const elvis_real extent = room * max(max(reach.x, reach.y), reach.z);
    const bool is_skipped = room > elvis_real(0) && is_linearized &&
                            core_is_far_outside(start, extent, elvis_fetch_core_curvatures(element, 0u));
    search.item = is_skipped ? CORE_NO_ITEM : element;
    core_begin_element(search, start);
#if CORE_STRONGLY_BENT
    const bool may_fold = elvis_fetch_core_curvatures(element, 0u) > CORE_MOST_MEASURED_CURVATURE;
    if (may_fold && !search.asks_own && room > elvis_real(0) && corners.all_hit) {
        core_begin_part(element, core_widened(corners, middle, room), normal, search);
    }
#endif
}
