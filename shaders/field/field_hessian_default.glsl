// elvis_field_hessian for snippets without: differences of elvis_field_gradient like those of gradient_default.glsl, with the same
// errors relative to the largest second derivative where the gradient is exact.

#include "arithmetic/stencil.glsl"

elvis_vec3 core_gradient_along(uint element, elvis_vec3 xi, elvis_vec3 direction, uint component) {
    elvis_real spacing;
    int first;
    bool is_centred;
    core_stencil(xi, direction, spacing, first, is_centred);
    elvis_vec3 derivative = elvis_vec3(0);
    for (int k = 0; k < 7; ++k) {
        elvis_real value;
        elvis_vec3 gradient;
        elvis_field_gradient(element, xi + (elvis_real(first + k) * spacing) * direction, component, value, gradient);
        derivative += core_gradient_weight(k, is_centred) * gradient;
    }
    return derivative / spacing;
}

void elvis_field_hessian(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient,
                         out elvis_mat3 hessian) {
    elvis_vec3 first, second, third;
    core_stencil_directions(xi, first, second, third);
    // H direction = derivative of the gradient, for three directions.
    const elvis_vec3 along_first = core_gradient_along(element, xi, first, component);
    const elvis_vec3 along_second = core_gradient_along(element, xi, second, component);
    const elvis_mat3 along = elvis_mat3(along_first, along_second, core_gradient_along(element, xi, third, component));
    const elvis_mat3 found = along * inverse(elvis_mat3(first, second, third));
    hessian = elvis_real(0.5LF) * (found + transpose(found));
    elvis_field_gradient(element, xi, component, value, gradient);
}
