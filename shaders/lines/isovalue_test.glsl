// Whether the field takes an isovalue in a square of the surface. The kernel brings core_isovalues and core_n_isovalues.

#include "lines/subpixel.glsl"
#if CORE_WITH_CONTOURS
#include "field/shown_model.glsl"
#include "isosurface/isovalues.glsl"
#endif

struct core_isovalue_test {
    // Of the field, where the mapping is linearized.
    elvis_real value;
    // The field surely takes no isovalue in the square.
    bool is_excluded;
    // The field surely takes one there, provided that the element fills the square.
    bool is_met;
    // The field's bounds are estimates.
    bool is_estimated;
};

core_isovalue_test core_isovalues_in(const core_element_image image, core_region square) {
    core_isovalue_test test = core_isovalue_test(elvis_real(0), true, false, false);
#if CORE_WITH_CONTOURS
    const core_model f = core_shown_model(image.element, image.xi, square, test.value);
    const elvis_vec4 change = core_at_corners(square, elvis_real(0), f.slope);
    // The corners themselves are within `beyond` of where they were predicted.
    const elvis_real error = CORE_MODEL_UP * (f.remainder + core_model_norm1(f.slope) *
                                                                (square.beyond + elvis_real(4) * CORE_ROUNDOFF * square.radius)) +
                             elvis_real(4) * CORE_ROUNDOFF * abs(f.value) + CORE_MODEL_TINY;
    const elvis_real least = f.value + core_least(change), most = f.value + core_most(change);
    const uint first = core_isovalue_from(least - error);
    const uint first_sure = core_isovalue_from(least + error);
    const bool is_known = core_model_is_known(f);
    test.is_excluded = is_known && (first == core_n_isovalues || core_isovalue_at(first) > most + error);
    test.is_met = is_known && first_sure < core_n_isovalues && core_isovalue_at(first_sure) <= most - error;
    test.is_estimated = core_n_isovalues > 0u && core_is_model_estimated(image.element);
#endif
    return test;
}
