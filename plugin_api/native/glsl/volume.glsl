// Snippet of the native volume: mapping and field as sums over the bases of plugins/native/device_space.hpp.
//
// shape.glsl defines a sum and its gradient; it is included once for the geometry (three numbers a mode) and once for the field.
// What it is told:
//   NATIVE_VALUE, _GRADIENT, _HESSIAN   names of the functions to define
//   NATIVE_TYPE                      type of the sum: elvis_real or elvis_vec3
//   NATIVE_P, _Q, _R, NATIVE_BASIS   orders; for pyramids 0 tensor, 1 modified, 2 orthogonal
//   NATIVE_SLAB_ROWS                 rows of four numbers from one slab of coefficients to the next
//   NATIVE_COEFFICIENT(row, mode)    coefficient `mode` of the slab that starts at `row`
//
// All loops have literal bounds equal to the length of an array that they index: compilers unroll those completely. Then every
// position is a literal, one fetch serves four numbers, and local arrays and recurrence coefficients cost nothing. Unrolled sums
// of order 14 (3375 coefficients) compile in half a second with lavapipe, and rolled ones ran no faster.

#include "recurrences.glsl"

#define NATIVE_VALUE native_mapping
#define NATIVE_GRADIENT native_mapping_gradient
#define NATIVE_HESSIAN native_mapping_hessian
#define NATIVE_TYPE elvis_vec3
#define NATIVE_P NATIVE_GEOMETRY_P
#define NATIVE_Q NATIVE_GEOMETRY_Q
#define NATIVE_R NATIVE_GEOMETRY_R
#define NATIVE_BASIS NATIVE_GEOMETRY_BASIS
#define NATIVE_SLAB_ROWS NATIVE_GEOMETRY_SLAB_ROWS
#define NATIVE_NUMBER(row, i) elvis_fetch4_geometry(element, (row) + uint((i) >> 2))[(i) & 3]
#define NATIVE_COEFFICIENT(row, mode)                                                                                              \
    elvis_vec3(NATIVE_NUMBER(row, 3 * (mode)), NATIVE_NUMBER(row, 3 * (mode) + 1), NATIVE_NUMBER(row, 3 * (mode) + 2))
#include "shape.glsl"
#undef NATIVE_VALUE
#undef NATIVE_GRADIENT
#undef NATIVE_HESSIAN
#undef NATIVE_TYPE
#undef NATIVE_P
#undef NATIVE_Q
#undef NATIVE_R
#undef NATIVE_BASIS
#undef NATIVE_SLAB_ROWS
#undef NATIVE_NUMBER
#undef NATIVE_COEFFICIENT

#define NATIVE_VALUE native_field
#define NATIVE_GRADIENT native_field_gradient
#define NATIVE_HESSIAN native_field_hessian
#define NATIVE_P NATIVE_FIELD_P
#define NATIVE_Q NATIVE_FIELD_Q
#define NATIVE_R NATIVE_FIELD_R
#define NATIVE_BASIS NATIVE_FIELD_BASIS
#define NATIVE_SLAB_ROWS NATIVE_FIELD_SLAB_ROWS
#define NATIVE_NUMBER(row, i) elvis_fetch4_field(element, (row) + uint((i) >> 2))[(i) & 3]
#if NATIVE_TRANSFORM == 0
#define NATIVE_TYPE elvis_real
#define NATIVE_COEFFICIENT(row, mode) NATIVE_NUMBER(row, mode)
#else
#define NATIVE_TYPE elvis_vec3
#define NATIVE_COEFFICIENT(row, mode)                                                                                              \
    elvis_vec3(NATIVE_NUMBER(row, 3 * (mode)), NATIVE_NUMBER(row, 3 * (mode) + 1), NATIVE_NUMBER(row, 3 * (mode) + 2))
#endif
#include "shape.glsl"
#undef NATIVE_VALUE
#undef NATIVE_GRADIENT
#undef NATIVE_HESSIAN
#undef NATIVE_TYPE
#undef NATIVE_P
#undef NATIVE_Q
#undef NATIVE_R
#undef NATIVE_BASIS
#undef NATIVE_SLAB_ROWS
#undef NATIVE_NUMBER
#undef NATIVE_COEFFICIENT

// A triangle is the section of a prism: its second direction is the prism's third.
#if ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
#define NATIVE_POINT(xi) (xi).xzy
#define NATIVE_SECOND x3
#define NATIVE_THIRD x2
#else
#define NATIVE_POINT(xi) (xi)
#define NATIVE_SECOND x2
#define NATIVE_THIRD x3
#endif

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return native_mapping(element, 0u, NATIVE_POINT(xi)); }

void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    elvis_vec3 x1, x2, x3;
    native_mapping_gradient(element, 0u, NATIVE_POINT(xi), x, x1, x2, x3);
    jacobian = elvis_mat3(x1, NATIVE_SECOND, NATIVE_THIRD);
}

elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, x, jacobian);
    return jacobian;
}

#if ELVIS_WANTS_HESSIANS
// Six second derivatives as a symmetric matrix, in the order of xi.
elvis_mat3 native_symmetric(elvis_real d11, elvis_real d22, elvis_real d33, elvis_real d23, elvis_real d13, elvis_real d12) {
#if ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    return elvis_mat3(d11, d13, d12, d13, d33, d23, d12, d23, d22);
#else
    return elvis_mat3(d11, d12, d13, d12, d22, d23, d13, d23, d33);
#endif
}

void elvis_mapping_hessian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian, out elvis_mat3 hessian_x,
                           out elvis_mat3 hessian_y, out elvis_mat3 hessian_z) {
    elvis_vec3 x1, x2, x3, x11, x22, x33, x23, x13, x12;
    native_mapping_hessian(element, 0u, NATIVE_POINT(xi), x, x1, x2, x3, x11, x22, x33, x23, x13, x12);
    jacobian = elvis_mat3(x1, NATIVE_SECOND, NATIVE_THIRD);
    hessian_x = native_symmetric(x11.x, x22.x, x33.x, x23.x, x13.x, x12.x);
    hessian_y = native_symmetric(x11.y, x22.y, x33.y, x23.y, x13.y, x12.y);
    hessian_z = native_symmetric(x11.z, x22.z, x33.z, x23.z, x13.z, x12.z);
}
#endif

#if NATIVE_TRANSFORM == 0

// Components follow one another in the record.
elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    return native_field(element, component * uint(NATIVE_FIELD_ROWS), NATIVE_POINT(xi));
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    elvis_real x1, x2, x3;
    native_field_gradient(element, component * uint(NATIVE_FIELD_ROWS), NATIVE_POINT(xi), value, x1, x2, x3);
    gradient = elvis_vec3(x1, NATIVE_SECOND, NATIVE_THIRD);
}

#if ELVIS_WANTS_HESSIANS
#include "field_hessian.glsl"
#endif

#else
#include "transform.glsl"
#endif
