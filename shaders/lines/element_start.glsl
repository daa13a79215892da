// Where in an element the search begins: what the linearized mapping (element/linearization.glsl) predicts for a pixel's part of the
// surface.

#include "element/linearization.glsl"

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

// Selects an element unless it lies elsewhere. `corners` around `middle`: the pixel's part of the surface, which reaches at most
// `room` times as far; infinitely far if that is zero.
void core_select_element(uint element, core_cut_square corners, elvis_vec3 middle, elvis_real room, inout core_line_search search) {
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
}
