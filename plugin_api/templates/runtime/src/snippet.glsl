// Trilinear hexahedra with a trilinear field: what the graphics processor evaluates for every pixel.
//
// Row k of a record of `corners` holds corner k of the element: x, y, z, value (plugin.cpp, fill_buffer).

// Reference coordinates of corner k, in the order of elvis/element.h.
elvis_vec3 @NAME@_corner(uint k) {
    return elvis_vec3(((k ^ (k >> 1u)) & 1u) != 0u ? 1 : -1, (k & 2u) != 0u ? 1 : -1, (k & 4u) != 0u ? 1 : -1);
}

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    elvis_vec3 x = elvis_vec3(0);
    for (uint k = 0u; k < 8u; ++k) {
        elvis_vec3 factor = elvis_vec3(1) + @NAME@_corner(k) * xi;
        x += factor.x * factor.y * factor.z * elvis_fetch4_corners(element, k).xyz;
    }
    return x / elvis_real(8);
}

// Column j is dx/dxi_j.
elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    elvis_mat3 jacobian = elvis_mat3(0);
    for (uint k = 0u; k < 8u; ++k) {
        elvis_vec3 corner = @NAME@_corner(k);
        elvis_vec3 factor = elvis_vec3(1) + corner * xi;
        elvis_vec3 x = elvis_fetch4_corners(element, k).xyz;
        jacobian[0] += corner.x * factor.y * factor.z * x;
        jacobian[1] += factor.x * corner.y * factor.z * x;
        jacobian[2] += factor.x * factor.y * corner.z * x;
    }
    return jacobian / elvis_real(8);
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    elvis_real value = elvis_real(0);
    for (uint k = 0u; k < 8u; ++k) {
        elvis_vec3 factor = elvis_vec3(1) + @NAME@_corner(k) * xi;
        value += factor.x * factor.y * factor.z * elvis_fetch4_corners(element, k).w;
    }
    return value / elvis_real(8);
}
