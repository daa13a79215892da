// The curvature (element/prediction.glsl) as it counts for predictions from a point at which J^-1 is known: less than that of the whole
// element, which holds wherever J^-1 may be larger. core_bends: three vectors for each element (core/volume/element/mapping_curvature.hpp).

#ifndef CORE_LOCAL_CURVATURE
#define CORE_LOCAL_CURVATURE

#include "element/element_frame.glsl"

// Half of the sum, and its rounding.
#define CORE_HALF_BEND elvis_real(0.5001LF)

// `curvature`: that of the element.
elvis_real core_curvature_at(uint element, const core_frame frame, elvis_real curvature) {
#if defined(elvis_fetch4_core_bends) && !defined(CORE_WITHOUT_BENDS)
    const elvis_vec3 bends0 = core_to_xi(frame, elvis_fetch4_core_bends(element, 0u).xyz);
    const elvis_vec3 bends1 = core_to_xi(frame, elvis_fetch4_core_bends(element, 1u).xyz);
    const elvis_vec3 bends2 = core_to_xi(frame, elvis_fetch4_core_bends(element, 2u).xyz);
    const elvis_real here = CORE_HALF_BEND * core_max_norm(abs(bends0) + abs(bends1) + abs(bends2));
    return here > elvis_real(0) && here < curvature ? here : curvature;
#else
    return curvature;
#endif
}

#endif
