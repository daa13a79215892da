// The sum of the class's shape; see volume.glsl for what it is told.
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
#include "hexahedron.glsl"
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM
#include "prism.glsl"
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
#include "pyramid.glsl"
#else
#include "tetrahedron.glsl"
#endif
