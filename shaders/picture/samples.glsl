// What a pixel sees of the surfaces drawn so far.

#ifndef CORE_SAMPLES
#define CORE_SAMPLES

#include "arithmetic/read_only.glsl"

// A depth behind everything.
#define CORE_FAR elvis_real(3.0e38LF)

// In place of an element's number: the surface lies in none.
#define CORE_NO_NUMBER 0xffffffffu

// Of pixels with an owner.
struct core_sample {
    // Field value, lacking the field's offset.
    elvis_real value;
    // Distance from the ray's origin.
    elvis_real depth;
    // The element's number.
    uint number;
};

// Apart from the samples, because pixels in which nothing is seen need no more.
struct core_mark {
    // Surface, counted from 1, and the bits below; 0 where nothing is seen.
    uint owner;
    // CORE_FLAG_...: the same bits as in the picture's buffers.
    uint flags;
};

// Both where they are only read (arithmetic/read_only.glsl).
#if CORE_READS_TEXELS
#define CORE_READ_SAMPLES(name) uniform usamplerBuffer name
#define CORE_READ_MARKS(name) uniform usamplerBuffer name

core_mark core_mark_of(uvec4 two, uint pixel) {
    return (pixel & 1u) == 0u ? core_mark(two.x, two.y) : core_mark(two.z, two.w);
}

#define CORE_MARK(name, pixel) core_mark_of(texelFetch(name, int((pixel) >> 1u)), pixel)
#define CORE_SAMPLE_VALUE(name, pixel) CORE_REAL(name, 3u * (pixel))
#define CORE_SAMPLE_DEPTH(name, pixel) CORE_REAL(name, 3u * (pixel) + 1u)
#if ELVIS_REAL_IS_DOUBLE
#define CORE_SAMPLE_NUMBER(name, pixel) CORE_WORD(name, 6u * (pixel) + 4u)
#else
#define CORE_SAMPLE_NUMBER(name, pixel) CORE_WORD(name, 3u * (pixel) + 2u)
#endif

#else
#define CORE_READ_SAMPLES(name) readonly buffer name##_block { core_sample name[]; }
#define CORE_READ_MARKS(name) readonly buffer name##_block { core_mark name[]; }

#define CORE_MARK(name, pixel) name[pixel]
#define CORE_SAMPLE_VALUE(name, pixel) name[pixel].value
#define CORE_SAMPLE_DEPTH(name, pixel) name[pixel].depth
#define CORE_SAMPLE_NUMBER(name, pixel) name[pixel].number
#endif

#define CORE_SAMPLE(name, pixel) \
    core_sample(CORE_SAMPLE_VALUE(name, pixel), CORE_SAMPLE_DEPTH(name, pixel), CORE_SAMPLE_NUMBER(name, pixel))

// Rank among the elements that share the point: side first, then number.
#define CORE_OWNER_KEY 1u
// The same bit of isosurfaces: the field rises along the ray.
#define CORE_OWNER_RISES 1u
// The point lies on a face of the element, within rounding.
#define CORE_OWNER_ON_FACE 2u
// Other elements hold it, too.
#define CORE_OWNER_SHARED 4u
// They have other values there, and rounding decides which one is shown.
#define CORE_OWNER_AMBIGUOUS 8u
// It is decided what lines the pixel meets, and written in the flags.
#define CORE_OWNER_SETTLED 16u
// Two elements hold it by more than rounding.
#define CORE_OWNER_OVERLAP 32u
#define CORE_OWNER_BITS 6

#define CORE_FLAG_CONTOUR 1u
#define CORE_FLAG_CONTOUR_UNDECIDED 2u
#define CORE_FLAG_MESH_LINE 4u
#define CORE_FLAG_NEWTON_FAILURE 8u
#define CORE_FLAG_NAN 16u
#define CORE_FLAG_ISOSURFACE 32u
#define CORE_FLAG_ISOSURFACE_UNDECIDED 64u
#define CORE_FLAG_VOLUME_TOLERANCE 128u
#define CORE_FLAG_UNDECIDED 256u
#define CORE_FLAG_MESH_UNDECIDED 512u
#define CORE_FLAG_WORK_LIMIT 1024u
#define CORE_FLAG_ESTIMATED 2048u
#define CORE_FLAG_RANGE_TOO_FINE 4096u
#define CORE_FLAG_OVERLAP 8192u

// Of a layer alone: a condition of the surface does not hold there (picture/condition.comp); its point is known less well than
// picture/place_error.glsl says.
#define CORE_FLAG_CUT 16384u
#define CORE_FLAG_VAGUE 32768u
#define CORE_PICTURE_FLAGS 0x3fffu

// Flags of a surface that stay where it is not seen: it may have missed something in front.
#define CORE_FLAGS_STAY (CORE_FLAG_NEWTON_FAILURE | CORE_FLAG_ISOSURFACE_UNDECIDED | CORE_FLAG_WORK_LIMIT | CORE_FLAG_ESTIMATED)
// Flags without open lines where such a line is found: one element may decide what another leaves open.
uint core_settled_lines(uint flags) {
    flags &= (flags & CORE_FLAG_CONTOUR) != 0u ? ~CORE_FLAG_CONTOUR_UNDECIDED : 0xffffffffu;
    return flags & ((flags & CORE_FLAG_MESH_LINE) != 0u ? ~CORE_FLAG_MESH_UNDECIDED : 0xffffffffu);
}

// Doubt about colours, of a surface that is seen through a transparent one. Whether lines are open tells of the nearest surface alone.
uint core_doubt_behind(uint flags) {
    const uint open_lines = core_settled_lines(flags) & (CORE_FLAG_CONTOUR_UNDECIDED | CORE_FLAG_MESH_UNDECIDED);
    return (flags & (CORE_FLAG_UNDECIDED | CORE_FLAG_OVERLAP | CORE_FLAG_RANGE_TOO_FINE)) | (open_lines != 0u ? CORE_FLAG_UNDECIDED : 0u);
}

// Where they stay, apart from those of what is seen.
#define CORE_STAYING(flags) ((flags) << 16)
// Rounding decides whether the surface has something in front of what was found.
#define CORE_FLAG_UNDECIDED_IN_FRONT (CORE_FLAG_UNDECIDED | CORE_STAYING(CORE_FLAG_UNDECIDED))

#endif
