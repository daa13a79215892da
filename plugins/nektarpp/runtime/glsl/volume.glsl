// Snippet of Nektar++ volumes: mapping and field as sums over the solver's own modes, with the coefficients of its files. The modes
// are those of README.md beside this folder, written so that no shape but the pyramid divides by a collapsed coordinate.
//
// sum.glsl defines one sum: value, with gradient, or with second derivatives too (NEKTAR_LEVEL 0, 1, 2), for the geometry (three
// numbers a mode) and for the field. What it is told:
//   NEKTAR_SUM                       name of the function to define, overloaded for the three levels
//   NEKTAR_TYPE                      type of the sum: elvis_real or elvis_vec3
//   NEKTAR_P, _Q, _R                 orders
//   NEKTAR_BASIS                     0 modified, 1 orthogonal, 2 Lagrange
//   NEKTAR_SLAB_ROWS                 hexahedra: rows of four numbers from one r to the next
//   NEKTAR_COEFFICIENT(row, mode)    coefficient `mode` of those that start at `row`
//
// All loops have literal bounds equal to the length of an array that they index: compilers unroll those completely. Then every
// position is a literal, one fetch serves four numbers, and tables and recurrence coefficients cost nothing.

#include "jets.glsl"
#if NEKTAR_FIELD_BASIS == 2
#include "nektar_nodes.glsl"
#endif

#define NEKTAR_SUM nektar_mapping
#define NEKTAR_TYPE elvis_vec3
#define NEKTAR_P NEKTAR_GEOMETRY_P
#define NEKTAR_Q NEKTAR_GEOMETRY_Q
#define NEKTAR_R NEKTAR_GEOMETRY_R
#define NEKTAR_BASIS 0
#define NEKTAR_SLAB_ROWS NEKTAR_GEOMETRY_SLAB_ROWS
#define NEKTAR_NUMBER(row, i) elvis_fetch4_geometry(element, (row) + uint((i) >> 2))[(i) & 3]
#define NEKTAR_COEFFICIENT(row, mode)                                                                                              \
    elvis_vec3(NEKTAR_NUMBER(row, 3 * (mode)), NEKTAR_NUMBER(row, 3 * (mode) + 1), NEKTAR_NUMBER(row, 3 * (mode) + 2))
#include "levels.glsl"
#undef NEKTAR_SUM
#undef NEKTAR_TYPE
#undef NEKTAR_P
#undef NEKTAR_Q
#undef NEKTAR_R
#undef NEKTAR_BASIS
#undef NEKTAR_SLAB_ROWS
#undef NEKTAR_NUMBER
#undef NEKTAR_COEFFICIENT

#define NEKTAR_SUM nektar_field
#define NEKTAR_TYPE elvis_real
#define NEKTAR_P NEKTAR_FIELD_P
#define NEKTAR_Q NEKTAR_FIELD_Q
#define NEKTAR_R NEKTAR_FIELD_R
#define NEKTAR_BASIS NEKTAR_FIELD_BASIS
#define NEKTAR_SLAB_ROWS NEKTAR_FIELD_SLAB_ROWS
#define NEKTAR_COEFFICIENT(row, mode) elvis_fetch4_field(element, (row) + uint((mode) >> 2))[(mode) & 3]
#include "levels.glsl"

// A triangle is the section of a prism: its second direction is the prism's third.
#if ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
#define NEKTAR_POINT(xi) (xi).xzy
#define NEKTAR_SECOND x3
#define NEKTAR_THIRD x2
#else
#define NEKTAR_POINT(xi) (xi)
#define NEKTAR_SECOND x2
#define NEKTAR_THIRD x3
#endif

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return nektar_mapping(element, NEKTAR_POINT(xi)); }

void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    elvis_vec3 x1, x2, x3;
    nektar_mapping(element, NEKTAR_POINT(xi), x, x1, x2, x3);
    jacobian = elvis_mat3(x1, NEKTAR_SECOND, NEKTAR_THIRD);
}

elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, x, jacobian);
    return jacobian;
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) { return nektar_field(element, NEKTAR_POINT(xi)); }

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    elvis_real x1, x2, x3;
    nektar_field(element, NEKTAR_POINT(xi), value, x1, x2, x3);
    gradient = elvis_vec3(x1, NEKTAR_SECOND, NEKTAR_THIRD);
}

#if ELVIS_WANTS_HESSIANS
// Six second derivatives as a symmetric matrix, in the order of xi.
elvis_mat3 nektar_symmetric(elvis_real d11, elvis_real d22, elvis_real d33, elvis_real d23, elvis_real d13, elvis_real d12) {
#if ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    return elvis_mat3(d11, d13, d12, d13, d33, d23, d12, d23, d22);
#else
    return elvis_mat3(d11, d12, d13, d12, d22, d23, d13, d23, d33);
#endif
}

void elvis_mapping_hessian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian, out elvis_mat3 hessian_x,
                           out elvis_mat3 hessian_y, out elvis_mat3 hessian_z) {
    elvis_vec3 x1, x2, x3, x11, x22, x33, x23, x13, x12;
    nektar_mapping(element, NEKTAR_POINT(xi), x, x1, x2, x3, x11, x22, x33, x23, x13, x12);
    jacobian = elvis_mat3(x1, NEKTAR_SECOND, NEKTAR_THIRD);
    hessian_x = nektar_symmetric(x11.x, x22.x, x33.x, x23.x, x13.x, x12.x);
    hessian_y = nektar_symmetric(x11.y, x22.y, x33.y, x23.y, x13.y, x12.y);
    hessian_z = nektar_symmetric(x11.z, x22.z, x33.z, x23.z, x13.z, x12.z);
}

void elvis_field_hessian(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient,
                         out elvis_mat3 hessian) {
    elvis_real x1, x2, x3, x11, x22, x33, x23, x13, x12;
    nektar_field(element, NEKTAR_POINT(xi), value, x1, x2, x3, x11, x22, x33, x23, x13, x12);
    gradient = elvis_vec3(x1, NEKTAR_SECOND, NEKTAR_THIRD);
    hessian = nektar_symmetric(x11, x22, x33, x23, x13, x12);
}
#endif
