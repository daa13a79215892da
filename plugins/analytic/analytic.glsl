// Trilinear hexahedra, and fields that are sums of closed-form terms of the world position.

// Row 2d + h of `geometry` holds, for direction d of space, the coefficients of 1, xi1, xi2, xi1 xi2 times xi3^h (see plugin.cpp).
elvis_vec4 analytic_coefficients(uint element, uint direction, elvis_real xi3) {
    return elvis_fetch4_geometry(element, 2u * direction) + xi3 * elvis_fetch4_geometry(element, 2u * direction + 1u);
}

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    elvis_vec4 products = elvis_vec4(elvis_real(1), xi.x, xi.y, xi.x * xi.y);
    return elvis_vec3(dot(analytic_coefficients(element, 0u, xi.z), products),
                      dot(analytic_coefficients(element, 1u, xi.z), products),
                      dot(analytic_coefficients(element, 2u, xi.z), products));
}

// Derivatives of one coordinate with respect to xi.
elvis_vec3 analytic_row(uint element, uint direction, elvis_vec3 xi) {
    elvis_vec4 c = analytic_coefficients(element, direction, xi.z);
    elvis_vec4 in_xi3 = elvis_fetch4_geometry(element, 2u * direction + 1u);
    return elvis_vec3(c.y + c.w * xi.y, c.z + c.w * xi.x, dot(in_xi3, elvis_vec4(elvis_real(1), xi.x, xi.y, xi.x * xi.y)));
}

elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    return transpose(elvis_mat3(analytic_row(element, 0u, xi), analytic_row(element, 1u, xi), analytic_row(element, 2u, xi)));
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    elvis_vec3 x = elvis_mapping(element, xi);
    elvis_real sum = elvis_real(0);
    for (uint term = 0u; term < uint(ANALYTIC_N_TERMS); ++term) {
        elvis_vec4 head = elvis_fetch4_terms(0u, 2u * term); // kind, component, amplitude, last parameter
        elvis_vec3 p = elvis_fetch4_terms(0u, 2u * term + 1u).xyz;
        elvis_vec3 d = x - p;
        elvis_real r2 = dot(d, d);
        elvis_real value = head.x == elvis_real(0)   ? elvis_sin(dot(p, x) + head.w)
                           : head.x == elvis_real(1) ? elvis_exp(-r2 / (head.w * head.w))
                                                     : elvis_real(1) / sqrt(r2);
        sum += head.y == elvis_real(component) ? head.z * value : elvis_real(0);
    }
    return sum;
}
