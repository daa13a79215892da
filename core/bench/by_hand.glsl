// What the kernel of a cut plane calls, for a scalar field of order 2 on hexahedra and prisms with mappings of order 1 in the native
// volume: as one would write it into the kernel by hand if there were no plugins. Orders and layout of the records
// (elvis/native/device_space.hpp) stand here as numbers; no loop, no basis in general, no fetch function in between.
//
// The host defines BY_HAND_GEOMETRY, BY_HAND_FIELD and BY_HAND_ORIGINS, the buffers; rows of four numbers a record (_ROWS); and
// BY_HAND_TEXELS.

#include "element/reference_shape.glsl"

#if BY_HAND_TEXELS
#define BY_HAND_ROW(buffer, row) texelFetch(buffer, int(row))
#else
#define BY_HAND_ROW(buffer, row) buffer[row]
#endif
#define BY_HAND_GEOMETRY_ROW(row) BY_HAND_ROW(BY_HAND_GEOMETRY, BY_HAND_GEOMETRY_ROWS * element + row)
#define BY_HAND_FIELD_ROW(row) BY_HAND_ROW(BY_HAND_FIELD, BY_HAND_FIELD_ROWS * element + row)

vec3 elvis_origin(uint element) { return BY_HAND_ROW(BY_HAND_ORIGINS, element).xyz; }

#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON

// 1, x along xi1, fastest; then along xi2; three rows a step along xi3.
void elvis_mapping_jacobian(uint element, vec3 xi, out vec3 x, out mat3 jacobian) {
    const vec4 a = BY_HAND_GEOMETRY_ROW(0u), b = BY_HAND_GEOMETRY_ROW(1u), c = BY_HAND_GEOMETRY_ROW(2u);
    const vec4 d = BY_HAND_GEOMETRY_ROW(3u), e = BY_HAND_GEOMETRY_ROW(4u), f = BY_HAND_GEOMETRY_ROW(5u);
    const vec3 slope0 = vec3(a.w, b.xy) + c.yzw * xi.y, slope1 = vec3(d.w, e.xy) + f.yzw * xi.y;
    const vec3 across0 = vec3(b.zw, c.x) + c.yzw * xi.x, across1 = vec3(e.zw, f.x) + f.yzw * xi.x;
    const vec3 x0 = a.xyz + vec3(a.w, b.xy) * xi.x + across0 * xi.y, x1 = d.xyz + vec3(d.w, e.xy) * xi.x + across1 * xi.y;
    x = x0 + x1 * xi.z;
    jacobian = mat3(slope0 + slope1 * xi.z, across0 + across1 * xi.z, x1);
}

// T_p(xi1) T_q(xi2) T_r(xi3), p fastest; three rows a step of r.
float by_hand_slab(uint element, uint row, vec2 xi, vec2 squares) {
    const vec4 a = BY_HAND_FIELD_ROW(row), b = BY_HAND_FIELD_ROW(row + 1u), c = BY_HAND_FIELD_ROW(row + 2u);
    return a.x + a.y * xi.x + a.z * squares.x + (a.w + b.x * xi.x + b.y * squares.x) * xi.y +
           (b.z + b.w * xi.x + c.x * squares.x) * squares.y;
}

float elvis_field_value(uint element, vec3 xi, uint component) {
    const vec3 squares = 2.0 * xi * xi - 1.0;
    return by_hand_slab(element, 0u, xi.xy, squares.xy) + by_hand_slab(element, 3u, xi.xy, squares.xy) * xi.z +
           by_hand_slab(element, 6u, xi.xy, squares.xy) * squares.z;
}

#else

// Prism: collapsed along xi1, x1 = xi1 + 1 - t with t = (1 - xi3)/2. Modes 1, P^{1,0}_1(xi3), x1; three rows a step along xi2.
void elvis_mapping_jacobian(uint element, vec3 xi, out vec3 x, out mat3 jacobian) {
    const vec4 a = BY_HAND_GEOMETRY_ROW(0u), b = BY_HAND_GEOMETRY_ROW(1u), c = BY_HAND_GEOMETRY_ROW(2u);
    const vec4 d = BY_HAND_GEOMETRY_ROW(3u), e = BY_HAND_GEOMETRY_ROW(4u), f = BY_HAND_GEOMETRY_ROW(5u);
    const float x1 = xi.x + 1.0 - 0.5 * (1.0 - xi.z), jacobi = 0.5 + 1.5 * xi.z;
    const vec3 up0 = vec3(a.w, b.xy), own0 = vec3(b.zw, c.x), up1 = vec3(d.w, e.xy), own1 = vec3(e.zw, f.x);
    const vec3 x_0 = a.xyz + up0 * jacobi + own0 * x1, x_1 = d.xyz + up1 * jacobi + own1 * x1;
    x = x_0 + x_1 * xi.y;
    jacobian = mat3(own0 + own1 * xi.y, x_1, 1.5 * up0 + 0.5 * own0 + (1.5 * up1 + 0.5 * own1) * xi.y);
}

// Two rows a step of T_q(xi2): P^{1,0}_0, _1, _2 (xi3); then P^{3,0}_0, _1 times x1; then t^2 P_2(x1/t).
float by_hand_slab(uint element, uint row, float x1, float square, vec3 jacobi) {
    const vec4 a = BY_HAND_FIELD_ROW(row);
    const vec2 b = BY_HAND_FIELD_ROW(row + 1u).xy;
    return a.x + a.y * jacobi.x + a.z * jacobi.y + (a.w + b.x * jacobi.z) * x1 + b.y * square;
}

float elvis_field_value(uint element, vec3 xi, uint component) {
    const float t = 0.5 * (1.0 - xi.z), x1 = xi.x + 1.0 - t, square = 1.5 * x1 * x1 - 0.5 * t * t;
    const float first = 0.5 + 1.5 * xi.z;
    const vec3 jacobi = vec3(first, (1.0 / 9.0 + 5.0 / 3.0 * xi.z) * first - 5.0 / 9.0, 1.5 + 2.5 * xi.z);
    return by_hand_slab(element, 0u, x1, square, jacobi) + by_hand_slab(element, 2u, x1, square, jacobi) * xi.y +
           by_hand_slab(element, 4u, x1, square, jacobi) * (2.0 * xi.y * xi.y - 1.0);
}
#endif
