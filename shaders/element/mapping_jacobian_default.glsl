// elvis_mapping_jacobian for snippets that give mapping and Jacobian only separately.

void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    x = elvis_mapping(element, xi);
    jacobian = elvis_jacobian(element, xi);
}
