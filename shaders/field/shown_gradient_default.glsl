// core_shown_gradient of expressions whose gradient takes third derivatives: differences of core_shown_value like those of
// gradient_default.glsl.

#include "arithmetic/stencil.glsl"

elvis_real core_shown_along(uint element, elvis_vec3 xi, elvis_vec3 direction) {
    elvis_real spacing;
    int first;
    bool is_centred;
    core_stencil(xi, direction, spacing, first, is_centred);
    elvis_real derivative = elvis_real(0);
    for (int k = 0; k < 7; ++k) {
        const elvis_vec3 point = xi + (elvis_real(first + k) * spacing) * direction;
        derivative += core_gradient_weight(k, is_centred) * core_shown_value(element, point);
    }
    return derivative / spacing;
}

void core_shown_gradient(uint element, elvis_vec3 xi, out elvis_real value, out elvis_vec3 gradient) {
    elvis_vec3 first, second, third;
    core_stencil_directions(xi, first, second, third);
    const elvis_real along_first = core_shown_along(element, xi, first);
    const elvis_real along_second = core_shown_along(element, xi, second);
    const elvis_vec3 along = elvis_vec3(along_first, along_second, core_shown_along(element, xi, third));
    // dot(gradient, direction) = along, for three directions.
    gradient = along * inverse(elvis_mat3(first, second, third));
    value = core_shown_value(element, xi);
}
