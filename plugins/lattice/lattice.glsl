// Trilinear hexahedra with fields that are quadratic in each direction.
//
// Rows 2d and 2d + 1 of a record of `geometry` hold, for direction d of space, the coefficients of 1, xi1, xi2, xi1 xi2 and of these
// times xi3, relative to the element's origin. Row 3c + b of a record of `field` holds the coefficients of 1, xi1, xi1^2 times
// xi2^b xi3^c.

void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    const elvis_vec4 products = elvis_vec4(elvis_real(1), xi.x, xi.y, xi.x * xi.y);
    elvis_vec3 rows[3];
    for (int d = 0; d < 3; ++d) {
        const elvis_vec4 upper = elvis_fetch4_geometry(element, uint(2 * d + 1));
        const elvis_vec4 here = elvis_fetch4_geometry(element, uint(2 * d)) + xi.z * upper;
        x[d] = dot(here, products);
        rows[d] = elvis_vec3(here.y + here.w * xi.y, here.z + here.w * xi.x, dot(upper, products));
    }
    jacobian = transpose(elvis_mat3(rows[0], rows[1], rows[2]));
}

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, x, jacobian);
    return x;
}

elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, x, jacobian);
    return jacobian;
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    const elvis_vec4 powers = elvis_vec4(elvis_real(1), xi.x, xi.x * xi.x, elvis_real(0));
    const elvis_vec4 slopes = elvis_vec4(elvis_real(0), elvis_real(1), elvis_real(2) * xi.x, elvis_real(0));
    value = elvis_real(0);
    gradient = elvis_vec3(0);
    for (int c = 2; c >= 0; --c) {
        elvis_real at = elvis_real(0), along = elvis_real(0), across = elvis_real(0);
        for (int b = 2; b >= 0; --b) {
            const elvis_vec4 row = elvis_fetch4_field(element, uint(3 * c + b));
            across = across * xi.y + at;
            at = at * xi.y + dot(row, powers);
            along = along * xi.y + dot(row, slopes);
        }
        gradient = elvis_vec3(gradient.x * xi.z + along, gradient.y * xi.z + across, gradient.z * xi.z + value);
        value = value * xi.z + at;
    }
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    elvis_real value;
    elvis_vec3 gradient;
    elvis_field_gradient(element, xi, component, value, gradient);
    return value;
}
