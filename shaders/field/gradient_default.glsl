// elvis_field_gradient for snippets that give field values only: differences of sixth order that stay inside the element.
//
// Derivatives are taken along three directions that lead from xi to corners of the tetrahedron c0 c1 c2 c3 = (-,-,-) (+,-,-)
// (-,+,-) (-,-,+), which every reference shape contains. Shapes are convex, so the way to a corner is inside, wherever xi is, a
// collapsed vertex included. The corner with the largest barycentric coordinate (>= 1/4 in size) is left out: the three directions
// are then independent.
//
// Along each direction the field is taken at seven equidistant points, spaced by a fraction of the way to the corner: centred if
// there is room behind xi, if need be with a spacing down to an eighth; else starting at xi. With a distance h between points,
//
//   centred    error <= h^6 |f^(7)| / 140 +  1.8 eps |f| / h       (weights +-1/60, +-3/20, +-3/4)
//   one-sided  error <= h^6 |f^(7)| / 7   + 27.7 eps |f| / h
//
// where eps is the relative error of a value. Each fraction suits waves of up to ten radians a unit length, some three in an
// element. Largest errors measured (tests/defaults), relative to the largest gradient, on all four shapes:
//
//   radians a unit length     1        3        6        10
//   float64, inside           3e-13    4e-13    3e-13    2e-12
//   float64, anywhere         2e-12    2e-12    4e-12    7e-11
//   float32, inside           3e-5     3e-5     3e-5     8e-5
//   float32, anywhere         5e-5     5e-5     2e-4     3e-3
// Outside the element (Newton's method passes there) the points start at xi.

#include "arithmetic/stencil.glsl"

// d/ds of the field at xi + s * direction, s = 0.
elvis_real core_directional_derivative(uint element, elvis_vec3 xi, elvis_vec3 direction, uint component) {
    elvis_real spacing;
    int first;
    bool is_centred;
    core_stencil(xi, direction, spacing, first, is_centred);
    elvis_real derivative = elvis_real(0);
    for (int k = 0; k < 7; ++k) {
        const elvis_vec3 point = xi + (elvis_real(first + k) * spacing) * direction;
        derivative += core_gradient_weight(k, is_centred) * elvis_field_value(element, point, component);
    }
    return derivative / spacing;
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    elvis_vec3 first, second, third;
    core_stencil_directions(xi, first, second, third);
    const elvis_real along_first = core_directional_derivative(element, xi, first, component);
    const elvis_real along_second = core_directional_derivative(element, xi, second, component);
    const elvis_real along_third = core_directional_derivative(element, xi, third, component);

    // The gradient g solves dot(g, direction) = derivative for the three directions (Cramer's rule).
    const elvis_vec3 normal = cross(second, third);
    gradient = (along_first * normal + along_second * cross(third, first) + along_third * cross(first, second)) / dot(first, normal);
    value = elvis_field_value(element, xi, component);
}
