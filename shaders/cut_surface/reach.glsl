// How far a strongly bent element reaches beyond the faces of its reference shape, in the coordinates of its linearized mapping
// (element/linearization.glsl): a point that lies farther out is not in the element, wherever Newton's method would go.
//
// Three words an element: the reaches over six faces in half precision, rounded up.

#ifndef CORE_REACH
#define CORE_REACH

#include "element/linearization.glsl"

// Predictions from the centroid tell enough of elements that are less bent.
#define CORE_LEAST_BENT 0.5
#define CORE_REACHES 6
// Nothing lies farther out.
#define CORE_UNKNOWN_REACH 60000.0

uint core_pack_reaches(float first, float second) {
    const vec2 reaches = vec2(first, second), rounding = abs(reaches) * exp2(-10.0) + exp2(-14.0);
    const bvec2 is_told = lessThan(reaches, vec2(CORE_UNKNOWN_REACH));
    return packHalf2x16(mix(vec2(CORE_UNKNOWN_REACH), reaches + rounding, is_told));
}

// Whether a point with these linearized coordinates lies farther out. `margin`: what they may be off.
bool core_is_beyond_reach(uvec4 packed, elvis_vec3 y, elvis_real margin) {
    bool is_beyond = false;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_real reach = elvis_real(unpackHalf2x16(packed[face / 2])[face % 2]);
        is_beyond = is_beyond || dot(constraint.xyz, y) + constraint.w > reach + margin;
    }
    return is_beyond;
}

#endif
