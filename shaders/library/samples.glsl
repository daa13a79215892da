// What a pixel sees of the surfaces drawn so far.

struct core_sample {
    // Field value, lacking the field's offset.
    elvis_real value;
    // Distance from the ray's origin.
    elvis_real depth;
    // Surface that is seen; CORE_NO_SURFACE for none.
    uint surface;
    // Rank among the elements that share the point: side, then number.
    uint key;
    uint number;
    // CORE_FLAG_...: the same bits as in the picture's buffers.
    uint flags;
};

#define CORE_NO_SURFACE 0xffffffffu
#define CORE_FLAG_NEWTON_FAILURE 8u
#define CORE_FLAG_NAN 16u
#define CORE_FLAG_UNDECIDED 256u
#define CORE_FLAG_WORK_LIMIT 1024u
#define CORE_FLAG_RANGE_TOO_FINE 4096u

core_sample core_no_sample() {
    // Farther than anything: 3e38 in both precisions.
    return core_sample(elvis_real(0), elvis_real(3.0e38), CORE_NO_SURFACE, 2u, 0xffffffffu, 0u);
}
