// The directions that a face of an element has: its outward unit normals lie within an angle of an axis. Measured
// (segments/face_cones.comp) for the faces of elements that are too curved for the linearized mapping to tell how rays cross them. In one
// word: the axis and the sine of the angle, each in eight bits; 1 where nothing is known.

#ifndef CORE_FACE_CONE
#define CORE_FACE_CONE

// Rounding to eight bits, of the axis and of the sine.
#define CORE_CONE_ROUNDING 0.016

uint core_pack_cone(vec3 axis, float sine) { return packSnorm4x8(vec4(axis, min(sine + CORE_CONE_ROUNDING, 1.0))); }

// By how much the direction, of unit length, surely points out of the face, or into it if `side` is -1; negative if it may not.
float core_cone_steepness(uint cone, vec3 direction, float side) {
    const vec4 axis_and_sine = unpackSnorm4x8(cone);
    return axis_and_sine.w > 0.99 ? -1.0 : side * dot(axis_and_sine.xyz, direction) - axis_and_sine.w;
}

#endif
