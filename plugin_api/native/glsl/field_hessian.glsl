// Left out of volumes with fields that have a transform: their second derivatives would take third ones of the mapping.
void elvis_field_hessian(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient,
                         out elvis_mat3 hessian) {
    elvis_real x1, x2, x3, x11, x22, x33, x23, x13, x12;
    native_field_hessian(element, component * uint(NATIVE_FIELD_ROWS), NATIVE_POINT(xi), value, x1, x2, x3, x11, x22, x33, x23, x13,
                         x12);
    gradient = elvis_vec3(x1, NATIVE_SECOND, NATIVE_THIRD);
    hessian = native_symmetric(x11, x22, x33, x23, x13, x12);
}
