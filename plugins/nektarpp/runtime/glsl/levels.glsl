// The sum of volume.glsl at each level that the kernel needs.
#define NEKTAR_LEVEL 0
#include "sum.glsl"
#undef NEKTAR_LEVEL
#define NEKTAR_LEVEL 1
#include "sum.glsl"
#undef NEKTAR_LEVEL
#if ELVIS_WANTS_HESSIANS
#define NEKTAR_LEVEL 2
#include "sum.glsl"
#undef NEKTAR_LEVEL
#endif
