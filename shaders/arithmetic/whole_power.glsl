// Powers to a whole number, by squares: exact to about n units of roundoff, and defined for negative x.

#ifndef CORE_WHOLE_POWER
#define CORE_WHOLE_POWER

elvis_real core_whole_power(elvis_real x, uint n) {
    elvis_real result = elvis_real(1), factor = x;
    // Unrolled where n is a literal, below 2^8; the host writes other exponents with elvis_pow.
    for (uint bit = 0u; bit < 8u; ++bit) {
        result = ((n >> bit) & 1u) != 0u ? result * factor : result;
        factor *= factor;
    }
    return result;
}

#endif
