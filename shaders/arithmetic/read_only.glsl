// Buffers that a kernel only reads. The host binds them like storage buffers.
//
// Drivers for CPUs read a storage buffer number by number and lane by lane, and a texel of four numbers at once: there they are texel
// buffers (CORE_READS_TEXELS).
//
//   layout(set = 0, binding = 2) CORE_READ_ROWS(core_rows);     of elvis_vec4;   CORE_ROW(core_rows, i)
//   layout(set = 0, binding = 3) CORE_READ_REALS(core_reals);   of elvis_real;   CORE_REAL(core_reals, i)
//   layout(set = 0, binding = 4) CORE_READ_WORDS(core_words);   of uint;         CORE_WORD(core_words, i)

#ifndef CORE_READ_ONLY
#define CORE_READ_ONLY

#if CORE_READS_TEXELS
#define CORE_READ_ROWS(name) uniform usamplerBuffer name
#define CORE_READ_REALS(name) uniform usamplerBuffer name
#define CORE_READ_WORDS(name) uniform usamplerBuffer name

#define CORE_WORD(name, index) texelFetch(name, int((index) >> 2u))[(index) & 3u]

#if ELVIS_REAL_IS_DOUBLE
elvis_vec4 core_row_of(uvec4 low, uvec4 high) {
    return elvis_vec4(packDouble2x32(low.xy), packDouble2x32(low.zw), packDouble2x32(high.xy), packDouble2x32(high.zw));
}
elvis_real core_real_of(uvec4 texel, uint index) { return packDouble2x32((index & 1u) == 0u ? texel.xy : texel.zw); }

#define CORE_ROW(name, row) core_row_of(texelFetch(name, int(2u * (row))), texelFetch(name, int(2u * (row) + 1u)))
#define CORE_REAL(name, index) core_real_of(texelFetch(name, int((index) >> 1u)), index)
#else
#define CORE_ROW(name, row) uintBitsToFloat(texelFetch(name, int(row)))
#define CORE_REAL(name, index) uintBitsToFloat(CORE_WORD(name, index))
#endif

#else
#define CORE_READ_ROWS(name) readonly buffer name##_block { elvis_vec4 name[]; }
#define CORE_READ_REALS(name) readonly buffer name##_block { elvis_real name[]; }
#define CORE_READ_WORDS(name) readonly buffer name##_block { uint name[]; }

#define CORE_ROW(name, row) name[row]
#define CORE_REAL(name, index) name[index]
#define CORE_WORD(name, index) name[index]
#endif

// Three reals from the first on.
#define CORE_REAL3(name, first) elvis_vec3(CORE_REAL(name, first), CORE_REAL(name, (first) + 1u), CORE_REAL(name, (first) + 2u))

#endif
