// elvis_mapping_hessian for snippets without: differences of elvis_jacobian like those of gradient_default.glsl.

#include "arithmetic/stencil.glsl"

elvis_mat3 core_jacobian_along(uint element, elvis_vec3 xi, elvis_vec3 direction) {
    elvis_real spacing;
    int first;
    bool is_centred;
    core_stencil(xi, direction, spacing, first, is_centred);
    elvis_mat3 derivative = elvis_mat3(0);
    for (int k = 0; k < 7; ++k) {
        const elvis_vec3 point = xi + (elvis_real(first + k) * spacing) * direction;
        derivative += core_gradient_weight(k, is_centred) * elvis_jacobian(element, point);
    }
    return derivative / spacing;
}

// Row i of each derivative of the Jacobian is M_i direction.
elvis_mat3 core_hessian_of(int i, elvis_mat3 along_first, elvis_mat3 along_second, elvis_mat3 along_third, elvis_mat3 to_reference) {
    const elvis_mat3 along = elvis_mat3(along_first[0][i], along_first[1][i], along_first[2][i], along_second[0][i], along_second[1][i],
                                        along_second[2][i], along_third[0][i], along_third[1][i], along_third[2][i]);
    const elvis_mat3 found = along * to_reference;
    return elvis_real(0.5LF) * (found + transpose(found));
}

void elvis_mapping_hessian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian, out elvis_mat3 hessian_x,
                           out elvis_mat3 hessian_y, out elvis_mat3 hessian_z) {
    elvis_vec3 first, second, third;
    core_stencil_directions(xi, first, second, third);
    const elvis_mat3 along_first = core_jacobian_along(element, xi, first);
    const elvis_mat3 along_second = core_jacobian_along(element, xi, second);
    const elvis_mat3 along_third = core_jacobian_along(element, xi, third);
    const elvis_mat3 to_reference = inverse(elvis_mat3(first, second, third));
    hessian_x = core_hessian_of(0, along_first, along_second, along_third, to_reference);
    hessian_y = core_hessian_of(1, along_first, along_second, along_third, to_reference);
    hessian_z = core_hessian_of(2, along_first, along_second, along_third, to_reference);
    elvis_mapping_jacobian(element, xi, x, jacobian);
}
