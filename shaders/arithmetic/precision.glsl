// Unit roundoff of elvis_real.

#ifndef CORE_PRECISION
#define CORE_PRECISION

#if ELVIS_REAL_IS_DOUBLE
#define CORE_ROUNDOFF elvis_real(1.1102230246251565e-16LF)
#else
#define CORE_ROUNDOFF elvis_real(5.9604644775390625e-8LF)
#endif

// Of the single precision that boxes are kept in.
#define CORE_FLOAT_ROUNDOFF 5.9604644775390625e-8

elvis_real core_norm1(elvis_vec3 v) { return abs(v.x) + abs(v.y) + abs(v.z); }

#endif
