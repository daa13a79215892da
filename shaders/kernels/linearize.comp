// The linearized inverse mapping of each element of a class, at its centroid (library/linearization.glsl), and how far the mapping
// is from linear (library/prediction.glsl): once for a volume.

layout(local_size_x = 32) in;

#include "library/face_frame.glsl"
#include "library/finite.glsl"
#include "library/linearization.glsl"
#include "library/shape_region.glsl"

layout(std430, set = 0, binding = 0) writeonly buffer core_output {
    // Eight words an element: exponents, the packed numbers, and the curvature as a float.
    uint core_words[];
};

layout(push_constant) uniform core_constants {
    uint core_first_element;
    uint core_n_elements;
};

// Maximum norm of the matrix with these rows times the difference of two Jacobians.
elvis_real core_norm(elvis_vec3 row0, elvis_vec3 row1, elvis_vec3 row2, elvis_mat3 a, elvis_mat3 b) {
    const elvis_vec3 d0 = a[0] - b[0], d1 = a[1] - b[1], d2 = a[2] - b[2];
    const elvis_real sum0 = abs(dot(row0, d0)) + abs(dot(row0, d1)) + abs(dot(row0, d2));
    const elvis_real sum1 = abs(dot(row1, d0)) + abs(dot(row1, d1)) + abs(dot(row1, d2));
    const elvis_real sum2 = abs(dot(row2, d0)) + abs(dot(row2, d1)) + abs(dot(row2, d2));
    return max(max(sum0, sum1), sum2);
}

// Slopes are measured between points, and are steeper elsewhere: what the factor is for.
const elvis_real core_curvature_safety = elvis_real(2);

// From the Jacobians on the way from the centroid to the corners, and to the middles of edges and faces.
elvis_real core_measured_curvature(uint element, elvis_mat3 jacobian, elvis_real determinant, elvis_vec3 row0, elvis_vec3 row1,
                                   elvis_vec3 row2) {
    elvis_real steepest = elvis_real(0);
    elvis_mat3 before = jacobian;
    for (int k = 0; k < 54; ++k) {
        const int place = k >> 1;
        const bool is_half_way = (k & 1) == 0;
        elvis_real x = elvis_real(place % 3 - 1), y = elvis_real(place / 3 % 3 - 1), z = elvis_real(place / 9 - 1);
        core_project(x, y, z);
        const elvis_vec3 way = elvis_vec3(x, y, z) - CORE_CENTROID;
        const elvis_real distance = elvis_real(0.5LF) * max(max(abs(way.x), abs(way.y)), abs(way.z));
        elvis_vec3 position;
        elvis_mat3 here;
        elvis_mapping_jacobian(element, CORE_CENTROID + (is_half_way ? elvis_real(0.5LF) : elvis_real(1)) * way, position, here);
        here = core_full_jacobian(here);
        const elvis_vec3 cofactors0 = cross(here[1], here[2]);
        const elvis_vec3 cofactors1 = cross(here[2], here[0]);
        const elvis_vec3 cofactors2 = cross(here[0], here[1]);
        const elvis_real here_determinant = dot(here[0], cofactors0);
        const elvis_real scale = elvis_real(1) / here_determinant;
        const elvis_mat3 from = is_half_way ? jacobian : before;
        const elvis_real norm = max(core_norm(row0, row1, row2, here, from),
                                    core_norm(scale * cofactors0, scale * cofactors1, scale * cofactors2, here, from));
        const bool is_sound = here_determinant * determinant > elvis_real(0) && core_is_finite(norm);
        const elvis_real slope = is_sound ? norm / distance : elvis_real(1e6LF);
        steepest = distance > elvis_real(0) ? max(steepest, slope) : steepest;
        before = here;
    }
    return core_curvature_safety * elvis_real(0.5LF) * steepest;
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_elements) {
        return;
    }
    const uint element = core_first_element + i;
    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, CORE_CENTROID, position, jacobian);
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

    const elvis_real curvature = core_measured_curvature(element, jacobian, determinant, row0, row1, row2);
    const core_linearization packed =
        core_pack_linearization(vec3(row0), vec3(row1), vec3(row2), vec3(offset), float(curvature));
    core_words[8u * i] = is_usable ? packed.exponents : 0u;
    core_words[8u * i + 1u] = packed.words[0];
    core_words[8u * i + 2u] = packed.words[1];
    core_words[8u * i + 3u] = packed.words[2];
    core_words[8u * i + 4u] = packed.words[3];
    core_words[8u * i + 5u] = packed.words[4];
    core_words[8u * i + 6u] = packed.words[5];
    core_words[8u * i + 7u] = floatBitsToUint(is_usable ? float(curvature) : 1e9);
}
