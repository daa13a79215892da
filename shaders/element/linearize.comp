// The linearized inverse mapping of each element of a class, at its centroid (element/linearization.glsl), and how far the mapping
// is from linear (element/prediction.glsl): once for a volume. And where it was seen to lie, for the host to compare with its bounds.
//
// The host proves curvatures where it can. CORE_IS_MEASURED 1: it cannot for some elements, of which they are measured.

layout(local_size_x = 32) in;

#include "element/face_frame.glsl"
#include "arithmetic/finite.glsl"
#include "element/linearization.glsl"
#include "element/shape_region.glsl"
#include "element/prediction.glsl"
#if CORE_IS_MEASURED
#include "element/measured_curvature.glsl"
#endif

#define CORE_WORDS 14u

layout(std430, set = 0, binding = 0) writeonly buffer core_output {
    // Fourteen words an element: exponents, the packed numbers, and as floats the curvature and the box of some positions.
    uint core_words[];
};

layout(std430, set = 0, binding = 1) readonly buffer core_input {
    // CORE_UNKNOWN_CURVATURE where one could be proven if it were small; negative where none can be.
    float core_proven[];
};

#if !CORE_IS_MEASURED
// The box of the corners, and of the middles of edges and faces of a cube, as far as that lies in the element.
elvis_vec3 core_seen_lower, core_seen_upper;

// At the centroid, which comes last: the snippet is compiled once.
void core_look_at_element(uint element, out elvis_vec3 position, out elvis_mat3 jacobian) {
    core_seen_lower = elvis_vec3(3e38);
    core_seen_upper = elvis_vec3(-3e38);
    for (int place = 0; place <= 27; ++place) {
        const elvis_vec3 corner = core_projected(elvis_vec3(place % 3 - 1, place / 3 % 3 - 1, place / 9 - 1));
        elvis_mapping_jacobian(element, place < 27 ? corner : CORE_CENTROID, position, jacobian);
        core_seen_lower = min(core_seen_lower, position);
        core_seen_upper = max(core_seen_upper, position);
    }
}
#endif

layout(push_constant) uniform core_constants {
    uint core_first_element;
    uint core_n_elements;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_elements) {
        return;
    }
    const uint element = core_first_element + i;
    elvis_vec3 position;
    elvis_mat3 jacobian;
#if !CORE_IS_MEASURED
    core_look_at_element(element, position, jacobian);
#else
    elvis_mapping_jacobian(element, CORE_CENTROID, position, jacobian);
#endif
    jacobian = core_full_jacobian(jacobian);
    const elvis_vec3 cofactors0 = cross(jacobian[1], jacobian[2]);
    const elvis_vec3 cofactors1 = cross(jacobian[2], jacobian[0]);
    const elvis_vec3 cofactors2 = cross(jacobian[0], jacobian[1]);
    const elvis_real determinant = dot(jacobian[0], cofactors0);
    const elvis_real inverse_determinant = elvis_real(1) / determinant;
    const elvis_vec3 row0 = inverse_determinant * cofactors0;
    const elvis_vec3 row1 = inverse_determinant * cofactors1;
    const elvis_vec3 row2 = inverse_determinant * cofactors2;
    const elvis_vec3 offset = CORE_CENTROID - elvis_vec3(dot(row0, position), dot(row1, position), dot(row2, position));
    const bool is_usable = core_is_finite(inverse_determinant) && core_is_finite(offset.x + offset.y + offset.z);

    // What is measured does not stand for a proof in the linearization, unless there cannot be one.
    const float proven = core_proven[i];
    float curvature = proven;
#if CORE_IS_MEASURED
    elvis_vec3 turn;
    const elvis_real measured =
        core_measured_curvature(element, CORE_CENTROID, jacobian, elvis_vec3(0), elvis_real(1), CORE_CURVATURE_STAGES, turn);
    const bool is_proven = proven >= 0.0 && elvis_real(proven) < CORE_UNKNOWN_CURVATURE;
    curvature = is_proven ? proven : float(measured);
#endif
    const core_linearization packed = core_pack_linearization(vec3(row0), vec3(row1), vec3(row2), vec3(offset),
                                                              proven < 0.0 ? curvature : proven);
    core_words[CORE_WORDS * i] = is_usable ? packed.exponents : 0u;
    core_words[CORE_WORDS * i + 1u] = packed.words[0];
    core_words[CORE_WORDS * i + 2u] = packed.words[1];
    core_words[CORE_WORDS * i + 3u] = packed.words[2];
    core_words[CORE_WORDS * i + 4u] = packed.words[3];
    core_words[CORE_WORDS * i + 5u] = packed.words[4];
    core_words[CORE_WORDS * i + 6u] = packed.words[5];
    core_words[CORE_WORDS * i + 7u] = floatBitsToUint(is_usable ? curvature : 1e9);
    for (uint axis = 0u; axis < 3u; ++axis) {
        core_words[CORE_WORDS * i + 8u + axis] = floatBitsToUint(float(core_seen_lower[axis]));
        core_words[CORE_WORDS * i + 11u + axis] = floatBitsToUint(float(core_seen_upper[axis]));
    }
}
