// Where rounding of the field moves a crossing by more than this, over the volume's size, the pixel is undecided.

#if ELVIS_REAL_IS_DOUBLE
#define CORE_DEPTH_TOLERANCE elvis_real(1e-12LF)
// Share of the bound of that which is met at worst.
#define CORE_ROOT_SHARE elvis_real(0.015625LF)
#else
#define CORE_DEPTH_TOLERANCE elvis_real(4e-6LF)
#define CORE_ROOT_SHARE elvis_real(0.125LF)
#endif
