// Types and constants of the GLSL interface (plugin_api/glsl_interface.md): the precision in use behind one set of names.

#ifndef CORE_TYPES
#define CORE_TYPES

#if ELVIS_REAL_IS_DOUBLE
#define elvis_real double
#define elvis_vec2 dvec2
#define elvis_vec3 dvec3
#define elvis_vec4 dvec4
#define elvis_mat3 dmat3
#else
#define elvis_real float
#define elvis_vec2 vec2
#define elvis_vec3 vec3
#define elvis_vec4 vec4
#define elvis_mat3 mat3
#endif

// As in elvis/element.h.
#define ELVIS_SHAPE_HEXAHEDRON 0
#define ELVIS_SHAPE_PRISM 1
#define ELVIS_SHAPE_PYRAMID 2
#define ELVIS_SHAPE_TETRAHEDRON 3
#define ELVIS_SHAPE_QUADRILATERAL 4
#define ELVIS_SHAPE_TRIANGLE 5

// For people who write snippets: a number to be shown by `elvis compile-snippet --at`; nothing otherwise.
#define elvis_debug(value)

#endif
