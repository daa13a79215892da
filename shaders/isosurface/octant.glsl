// An octant is an eighth of an element, or of another octant. Only those that can hold an isovalue are stored
// (core/volume/isosurface/isovalue_set.hpp), each with linear models of the inverse mapping and of the field in single precision: what can
// be told of both along a ray before anything is evaluated.
//
// A point x of the octant, relative to the hierarchies' centre, has the local coordinates
//
//     y = R (x - middle),   |y| <= 1 in every coordinate,   xi = m + size y + e,   |e| <= size - h,
//
// with m the middle of the octant in reference coordinates and h half its side: so size = h plus what the linearization leaves out.
// And for the field
//
//     f = value + slope . y + d,   |d| <= error.
//
// with an error of CORE_VALUE_UNKNOWN where nothing is known. The curvature is that of element/prediction.glsl in the octant. Where there
// is no linearization, y is of the octant's box, and size and slope are zero: value and error tell the field's range.

#ifndef CORE_OCTANT
#define CORE_OCTANT

#define CORE_VALUE_UNKNOWN 3e38
// Of single precision, in x and in all that is computed of y.
#define CORE_OCTANT_ROUNDING (32.0 * CORE_FLOAT_ROUNDOFF)

struct core_octant {
    vec3 row0, row1, row2;
    vec3 middle;
    vec3 slope;
    float value, error;
    float size;
    uint element;
    uint code;
    float curvature;
};

// Level, then the octant's place along each side, then a bit for octants whose models are estimates.
#define CORE_OCTANT_PLACE_BITS 6
#define CORE_OCTANT_ESTIMATED 0x80000000u

float core_octant_half_side(uint code) { return exp2(-float(code & 7u)); }

vec3 core_octant_middle(uint code) {
    const uint mask = (1u << CORE_OCTANT_PLACE_BITS) - 1u;
    const vec3 place = vec3((code >> 3) & mask, (code >> (3 + CORE_OCTANT_PLACE_BITS)) & mask,
                            (code >> (3 + 2 * CORE_OCTANT_PLACE_BITS)) & mask);
    return (2.0 * place + 1.0) * core_octant_half_side(code) - 1.0;
}

// Whether it is bent so much that there is no linear model.
bool core_is_bent(core_octant octant) { return octant.size == 0.0; }

#ifdef elvis_fetch4_core_octants

core_octant core_fetch_octant(uint index) {
    const uvec4 a = elvis_fetch4_core_octants(index, 0u), b = elvis_fetch4_core_octants(index, 1u);
    const uvec4 c = elvis_fetch4_core_octants(index, 2u), d = elvis_fetch4_core_octants(index, 3u);
    const uvec4 e = elvis_fetch4_core_octants(index, 4u);
    core_octant octant;
    octant.row0 = uintBitsToFloat(a.xyz);
    octant.row1 = uintBitsToFloat(b.xyz);
    octant.row2 = uintBitsToFloat(c.xyz);
    octant.middle = vec3(uintBitsToFloat(a.w), uintBitsToFloat(b.w), uintBitsToFloat(c.w));
    octant.slope = uintBitsToFloat(d.xyz);
    octant.value = uintBitsToFloat(d.w);
    octant.error = uintBitsToFloat(e.x);
    octant.size = uintBitsToFloat(e.y);
    octant.element = e.z;
    octant.code = e.w;
    octant.curvature = uintBitsToFloat(elvis_fetch4_core_octants(index, 5u).x);
    return octant;
}

vec3 core_octant_rotate(const core_octant octant, vec3 v) { return vec3(dot(octant.row0, v), dot(octant.row1, v), dot(octant.row2, v)); }

// How wrong y is for points given by coordinates of this size, beyond what the octant itself allows for.
float core_octant_tolerance(const core_octant octant, float far) {
    const vec3 ones = vec3(1);
    const float norm = max(max(dot(abs(octant.row0), ones), dot(abs(octant.row1), ones)), dot(abs(octant.row2), ones));
    return CORE_OCTANT_ROUNDING * far * norm;
}

float core_octant_error(const core_octant octant, float tolerance) {
    return octant.error + tolerance * dot(abs(octant.slope), vec3(1));
}

#endif

#endif
