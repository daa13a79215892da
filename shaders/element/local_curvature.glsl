// The curvature (element/prediction.glsl) as it counts for predictions from a point at which J^-1 is known: less than that of the whole
// element, which holds wherever J^-1 may be larger. It is proven where that of the element is not, too. core_bends: three vectors for each
// element (core/volume/element/mapping_curvature.hpp), zero where nothing is known.

#ifndef CORE_LOCAL_CURVATURE
#define CORE_LOCAL_CURVATURE

#include "element/element_frame.glsl"
#include "element/prediction.glsl"

// Half of the sum, and its rounding.
#define CORE_HALF_BEND elvis_real(0.5001LF)
// Larger ones of an element are measured, not proven (core/volume/element/mapping_curvature.cpp), and may be too small.
#define CORE_MOST_MEASURED_CURVATURE elvis_real(4)

#if defined(elvis_fetch4_core_bends) && !defined(CORE_WITHOUT_BENDS)
// CORE_UNKNOWN_CURVATURE where nothing is known of the element.
elvis_real core_proven_curvature_at(uint element, const core_frame frame) {
    const elvis_vec3 bends0 = core_to_xi(frame, elvis_fetch4_core_bends(element, 0u).xyz);
    const elvis_vec3 bends1 = core_to_xi(frame, elvis_fetch4_core_bends(element, 1u).xyz);
    const elvis_vec3 bends2 = core_to_xi(frame, elvis_fetch4_core_bends(element, 2u).xyz);
    const elvis_real here = CORE_HALF_BEND * core_max_norm(abs(bends0) + abs(bends1) + abs(bends2));
    return here > elvis_real(0) ? min(here, CORE_UNKNOWN_CURVATURE) : CORE_UNKNOWN_CURVATURE;
}

// By how much the sums of the Jacobian's rows change at most over a distance of 1.
elvis_vec3 core_proven_turn(uint element) {
    return elvis_real(2) * CORE_HALF_BEND *
           (abs(elvis_fetch4_core_bends(element, 0u).xyz) + abs(elvis_fetch4_core_bends(element, 1u).xyz) +
            abs(elvis_fetch4_core_bends(element, 2u).xyz));
}
#else
elvis_real core_proven_curvature_at(uint element, const core_frame frame) { return CORE_UNKNOWN_CURVATURE; }
elvis_vec3 core_proven_turn(uint element) { return elvis_vec3(CORE_UNKNOWN_CURVATURE); }
#endif

// `curvature`: that of the element. A larger one than CORE_MOST_MEASURED_CURVATURE counts only where none is proven here.
elvis_real core_curvature_at(uint element, const core_frame frame, elvis_real curvature) {
    const elvis_real here = core_proven_curvature_at(element, frame);
    return curvature > CORE_MOST_MEASURED_CURVATURE && here < CORE_UNKNOWN_CURVATURE ? here : min(here, curvature);
}

#endif
