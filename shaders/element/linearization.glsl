// The mapping linearized at the centroid, inverted: xi ~ offset + matrix * (x - origin). Newton's method starts from it, which
// saves the first evaluation and lets most candidates that do not hold the point be dismissed after one.
//
// It is stored in six words as 16-bit fractions, since a start needs three digits: each row of the matrix and the offset times a
// power of two. The rows' exponents, as a float's, stand in the lower bytes of `exponents`; the offset's, less
// core_min_offset_exponent, in the upper five bits; and the three bits between hold the curvature (element/prediction.glsl) rounded
// up to a power of two. exponents == 0: there is no linearization.

#ifndef CORE_LINEARIZATION
#define CORE_LINEARIZATION

// A smaller offset needs no exponent of its own; beyond 2^10 (positions far from their origin, in elements' lengths) too few digits
// would be left.
const uint core_min_offset_exponent = 119u;
const uint core_max_offset_exponent = 137u;
const uint core_unknown_curvature_level = 7u;

struct core_linearization {
    uint exponents;
    uint words[6];
};

// From the host's buffer core_elements: for each local element its number, exponents and words.
#ifdef elvis_fetch4_core_elements
core_linearization core_fetch_linearization(uint element) {
    const uvec4 first = elvis_fetch4_core_elements(element, 0u);
    const uvec4 second = elvis_fetch4_core_elements(element, 1u);
    return core_linearization(first.y, uint[6](first.z, first.w, second.x, second.y, second.z, second.w));
}
#endif

float core_scale(uint exponents, int which) {
    return uintBitsToFloat(((exponents >> (8 * which)) & 255u) << 23);
}

vec3 core_linear_inverse(core_linearization packed, vec3 x) {
    const vec2 w0 = unpackSnorm2x16(packed.words[0]), w1 = unpackSnorm2x16(packed.words[1]), w2 = unpackSnorm2x16(packed.words[2]);
    const vec2 w3 = unpackSnorm2x16(packed.words[3]), w4 = unpackSnorm2x16(packed.words[4]), w5 = unpackSnorm2x16(packed.words[5]);
    const float offset = uintBitsToFloat(((packed.exponents >> 27) + core_min_offset_exponent) << 23);
    return vec3(offset * w4.y + core_scale(packed.exponents, 0) * dot(vec3(w0, w1.x), x),
                offset * w5.x + core_scale(packed.exponents, 1) * dot(vec3(w1.y, w2), x),
                offset * w5.y + core_scale(packed.exponents, 2) * dot(vec3(w3, w4.x), x));
}

// How that changes along a direction.
vec3 core_linear_motion(core_linearization packed, vec3 direction) {
    const vec2 w0 = unpackSnorm2x16(packed.words[0]), w1 = unpackSnorm2x16(packed.words[1]), w2 = unpackSnorm2x16(packed.words[2]);
    const vec2 w3 = unpackSnorm2x16(packed.words[3]), w4 = unpackSnorm2x16(packed.words[4]);
    return vec3(core_scale(packed.exponents, 0) * dot(vec3(w0, w1.x), direction),
                core_scale(packed.exponents, 1) * dot(vec3(w1.y, w2), direction),
                core_scale(packed.exponents, 2) * dot(vec3(w3, w4.x), direction));
}

// Exponent of a power of two that no entry exceeds; 0 if there is none.
uint core_common_exponent(vec3 row) {
    const float largest = max(max(abs(row.x), abs(row.y)), abs(row.z));
    const uint exponent = (floatBitsToUint(largest) >> 23) + 1u;
    return largest > 0.0 && exponent < 254u ? exponent : 0u;
}

float core_curvature(uint exponents) {
    const uint level = exponents == 0u ? core_unknown_curvature_level : (exponents >> 24) & 7u;
    return level == core_unknown_curvature_level ? 1e9 : (level == 0u ? 1.0 / 1024.0 : exp2(float(level) - 6.0));
}

uint core_curvature_level(float curvature) {
    const float level = max(ceil(log2(curvature)) + 6.0, 1.0);
    return curvature <= 1.0 / 1024.0 ? 0u : (level <= 6.0 ? uint(level) : core_unknown_curvature_level);
}

core_linearization core_pack_linearization(vec3 row0, vec3 row1, vec3 row2, vec3 offset, float curvature) {
    const uint e0 = core_common_exponent(row0), e1 = core_common_exponent(row1), e2 = core_common_exponent(row2);
    const uint e3 = max(core_common_exponent(offset), core_min_offset_exponent);
    const bool is_usable = e0 != 0u && e1 != 0u && e2 != 0u && e3 <= core_max_offset_exponent;
    core_linearization packed;
    packed.exponents = is_usable ? (e0 | (e1 << 8) | (e2 << 16) | (core_curvature_level(curvature) << 24) |
                                     ((e3 - core_min_offset_exponent) << 27))
                                  : 0u;
    const vec3 r0 = row0 / uintBitsToFloat(e0 << 23), r1 = row1 / uintBitsToFloat(e1 << 23), r2 = row2 / uintBitsToFloat(e2 << 23);
    const vec3 o = offset / uintBitsToFloat(e3 << 23);
    packed.words[0] = packSnorm2x16(r0.xy);
    packed.words[1] = packSnorm2x16(vec2(r0.z, r1.x));
    packed.words[2] = packSnorm2x16(r1.yz);
    packed.words[3] = packSnorm2x16(r2.xy);
    packed.words[4] = packSnorm2x16(vec2(r2.z, o.x));
    packed.words[5] = packSnorm2x16(o.yz);
    return packed;
}

#endif
