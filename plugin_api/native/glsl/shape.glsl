// The sum of the class's shape; see volume.glsl for what it is told.
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON || ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
#include "hexahedron.glsl"
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
#include "prism.glsl"
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
#include "pyramid.glsl"
#else
#include "tetrahedron.glsl"
#endif
