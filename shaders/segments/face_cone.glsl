// The directions that a face of an element has: its outward unit normals lie within an angle of an axis. Measured
// (segments/face_cones.comp) for the faces of elements that are too curved for the linearized mapping to tell how rays cross them. In one
// word: the axis and the sine of the angle, each in eight bits; 1 where nothing is known.

//
// And how much it is bent: half the Lipschitz constant of its tangents, relative to them and the normal (core_face_tangents), in the maximum
// norm of its parameters. Six faces in two words behind the cones.

#ifndef CORE_FACE_CONE
#define CORE_FACE_CONE

// Place of the two words.
#define CORE_CONE_CURVATURES 6u
// Of logarithms in ten bits: steps in a power of two, and the smallest power.
#define CORE_CURVATURE_STEPS 32.0
#define CORE_LEAST_CURVATURE -12.0

// Rounding to eight bits, of the axis and of the sine.
#define CORE_CONE_ROUNDING 0.016

uint core_pack_cone(vec3 axis, float sine) { return packSnorm4x8(vec4(axis, min(sine + CORE_CONE_ROUNDING, 1.0))); }

// By how much the direction, of unit length, surely points out of the face, or into it if `side` is -1; negative if it may not.
float core_cone_steepness(uint cone, vec3 direction, float side) {
    const vec4 axis_and_sine = unpackSnorm4x8(cone);
    return axis_and_sine.w > 0.99 ? -1.0 : side * dot(axis_and_sine.xyz, direction) - axis_and_sine.w;
}

// Bits of the face in its word; rounded up.
uint core_pack_face_curvature(float curvature, int face) {
    const float code = ceil(CORE_CURVATURE_STEPS * (log2(max(curvature, 1e-30)) - CORE_LEAST_CURVATURE));
    return uint(clamp(code + 1.0, 0.0, 1023.0)) << (10 * (face % 3));
}

float core_unpack_face_curvature(uint word, int face) {
    return exp2(float(word >> (10 * (face % 3)) & 1023u) / CORE_CURVATURE_STEPS + CORE_LEAST_CURVATURE);
}

#endif
