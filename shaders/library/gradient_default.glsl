// elvis_field_gradient for snippets that give field values only: differences of sixth order that stay inside the element.
//
// Derivatives are taken along three directions that lead from xi to corners of the tetrahedron c0 c1 c2 c3 = (-,-,-) (+,-,-) (-,+,-) (-,-,+),
// which every reference shape contains. Shapes are convex, so the way to a corner is inside, wherever xi is, a collapsed vertex included.
// The corner with the largest barycentric coordinate (>= 1/4 in size) is left out: the three directions are then independent.
//
// Along each direction seven equidistant values are interpolated and the polynomial's derivative is taken at xi; the stencil is centred
// when there is room behind xi, and shifted forwards when there is not. With spacing h (a fraction of the way to the corner) the error is
// about h^6 |f^(7)| / 7 + 4 eps |f| / h centred, some twenty times more fully shifted; h balances the two.
// Outside the element (Newton's method passes there) the stencil starts at xi.

#if ELVIS_REAL_IS_DOUBLE
#define CORE_GRADIENT_SPACING elvis_real(0.01LF)
#else
#define CORE_GRADIENT_SPACING elvis_real(0.1LF)
#endif

// Derivative of the k-th Lagrange polynomial on the nodes 0, 1, .., 6 at theta.
elvis_real core_gradient_weight(int k, elvis_real theta) {
    elvis_real sum = elvis_real(0);
    elvis_real scale = elvis_real(1);
    for (int left_out = 0; left_out < 7; ++left_out) {
        elvis_real product = left_out == k ? elvis_real(0) : elvis_real(1);
        for (int node = 0; node < 7; ++node) {
            product *= (node == k || node == left_out) ? elvis_real(1) : theta - elvis_real(node);
        }
        sum += product;
        scale *= left_out == k ? elvis_real(1) : elvis_real(k - left_out);
    }
    return sum / scale;
}

// d/ds of the field at xi + s * direction, s = 0.
elvis_real core_directional_derivative(uint element, elvis_vec3 xi, elvis_vec3 direction, uint component) {
    const elvis_real spacing = CORE_GRADIENT_SPACING;
    elvis_real behind = core_room(xi, -direction, elvis_real(3) * spacing);
    elvis_real theta = behind / spacing;
    elvis_real derivative = elvis_real(0);
    for (int k = 0; k < 7; ++k) {
        elvis_vec3 node = xi + (elvis_real(k) * spacing - behind) * direction;
        derivative += core_gradient_weight(k, theta) * elvis_field_value(element, node, component);
    }
    return derivative / spacing;
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    // Barycentric coordinates of c1, c2, c3; that of c0 is what remains.
    elvis_vec3 b = elvis_real(0.5LF) * (xi + elvis_vec3(1));
    elvis_real b0 = elvis_real(1) - b.x - b.y - b.z;
    elvis_vec3 to_0 = elvis_vec3(-1, -1, -1) - xi;
    elvis_vec3 first = elvis_vec3(1, -1, -1) - xi;
    elvis_vec3 second = elvis_vec3(-1, 1, -1) - xi;
    elvis_vec3 third = elvis_vec3(-1, -1, 1) - xi;
    elvis_real largest = max(max(abs(b.x), abs(b.y)), max(abs(b.z), abs(b0)));
    if (abs(b.x) == largest) {
        first = to_0;
    } else if (abs(b.y) == largest) {
        second = to_0;
    } else if (abs(b.z) == largest) {
        third = to_0;
    }
    elvis_real along_first = core_directional_derivative(element, xi, first, component);
    elvis_real along_second = core_directional_derivative(element, xi, second, component);
    elvis_real along_third = core_directional_derivative(element, xi, third, component);

    // The gradient g solves dot(g, direction) = derivative for the three directions (Cramer's rule).
    elvis_vec3 normal = cross(second, third);
    gradient = (along_first * normal + along_second * cross(third, first) + along_third * cross(first, second)) / dot(first, normal);
    value = elvis_field_value(element, xi, component);
}
