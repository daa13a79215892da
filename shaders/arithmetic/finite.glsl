// Tests for NaN and infinity on the bits: drivers may assume in arithmetic that neither exists.

#ifndef CORE_FINITE
#define CORE_FINITE

bool core_is_finite(elvis_real x) {
#if ELVIS_REAL_IS_DOUBLE
    return (unpackDouble2x32(x).y & 0x7ff00000u) != 0x7ff00000u;
#else
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
#endif
}

#endif
