// Vector fields stored as uhat: u = J^-T uhat (covariant, NATIVE_TRANSFORM 1) or u = J uhat / det J (contravariant, 2), less the
// offset in the record's last row. In two dimensions J is that of the first two coordinates: its third column is (0, 0, 1), and
// uhat's third component 0.

elvis_mat3 native_jacobian(uint element, elvis_vec3 xi) {
    elvis_mat3 jacobian = elvis_jacobian(element, xi);
#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    jacobian[2] = elvis_vec3(0, 0, 1);
#endif
    return jacobian;
}

elvis_vec3 native_transform(elvis_mat3 jacobian, elvis_vec3 hat) {
#if NATIVE_TRANSFORM == 1
    return hat * inverse(jacobian);
#else
    return jacobian * hat / determinant(jacobian);
#endif
}

elvis_real native_component(elvis_vec3 v, uint component) { return component == 0u ? v.x : component == 1u ? v.y : v.z; }

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    elvis_vec3 u = native_transform(native_jacobian(element, xi), native_field(element, 0u, NATIVE_POINT(xi)));
    return native_component(u - elvis_fetch4_field(element, uint(NATIVE_FIELD_ROWS)).xyz, component);
}

// Half the number of points of a central difference that is exact for the Jacobian on the lines below.
#if ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID && NATIVE_GEOMETRY_BASIS != 0
#define NATIVE_PAIRS NATIVE_GEOMETRY_R
#else
#define NATIVE_PAIRS ((max(max(NATIVE_GEOMETRY_P, NATIVE_GEOMETRY_Q), NATIVE_GEOMETRY_R) + 1) / 2)
#endif

// Derivative of the Jacobian along `line`. J is a polynomial on lines along the axes in all shapes but pyramids, in
// these on lines of constant xi3 and on those through the apex: a central difference with enough points is exact there. The
// points lie within `reach` times `line` of xi.
elvis_mat3 native_bend(uint element, elvis_vec3 xi, elvis_vec3 line, elvis_real reach) {
    elvis_real spacing = reach / elvis_real(NATIVE_PAIRS);
    elvis_real weight = elvis_real(2 * NATIVE_PAIRS) / elvis_real(NATIVE_PAIRS + 1);
    elvis_mat3 sum = elvis_mat3(0);
    for (int i = 1; i <= NATIVE_PAIRS; ++i) {
        elvis_vec3 step = elvis_real(i) * spacing * line;
        sum += weight * (native_jacobian(element, xi + step) - native_jacobian(element, xi - step));
        weight *= -elvis_real(i * (NATIVE_PAIRS - i)) / elvis_real((i + 1) * (NATIVE_PAIRS + i + 1));
    }
    return sum / (elvis_real(2) * spacing);
}

// du/dxi_k, with K = dJ/dxi_k: J^-T (duhat/dxi_k - K^T u), or (K uhat + J duhat/dxi_k) / det J - u tr(J^-1 K).
elvis_real native_derivative(elvis_mat3 jacobian, elvis_mat3 bend, elvis_vec3 hat, elvis_vec3 hat_derivative, uint component) {
    elvis_vec3 u = native_transform(jacobian, hat);
#if NATIVE_TRANSFORM == 1
    elvis_vec3 derivative = native_transform(jacobian, hat_derivative - u * bend);
#else
    elvis_mat3 relative = inverse(jacobian) * bend;
    elvis_vec3 derivative = native_transform(jacobian, hat_derivative) + bend * hat / determinant(jacobian) -
                            u * (relative[0][0] + relative[1][1] + relative[2][2]);
#endif
    return native_component(derivative, component);
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    elvis_vec3 hat, x1, x2, x3;
    native_field_gradient(element, 0u, NATIVE_POINT(xi), hat, x1, x2, x3);
    elvis_mat3 jacobian = native_jacobian(element, xi);
#if ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
    // Along the line through the apex eta1 and eta2 are constant: d/dxi3 = d/dline + (1 + eta1)/2 d/dxi1 + (1 + eta2)/2 d/dxi2.
    // Points stay on this side of the apex, t > 0.
    elvis_real t = max((elvis_real(1) - xi.z) * elvis_real(0.5LF), elvis_real(1.0e-6LF));
    elvis_real drift1 = (elvis_real(1) + xi.x) / t * elvis_real(0.5LF), drift2 = (elvis_real(1) + xi.y) / t * elvis_real(0.5LF);
    elvis_mat3 bend1 = native_bend(element, xi, elvis_vec3(1, 0, 0), t);
    elvis_mat3 bend2 = native_bend(element, xi, elvis_vec3(0, 1, 0), t);
    elvis_mat3 bend3 = native_bend(element, xi, elvis_vec3(-drift1, -drift2, 1), t) + drift1 * bend1 + drift2 * bend2;
#else
    elvis_mat3 bend1 = native_bend(element, xi, elvis_vec3(1, 0, 0), elvis_real(1));
    elvis_mat3 bend2 = native_bend(element, xi, elvis_vec3(0, 1, 0), elvis_real(1));
    elvis_mat3 bend3 = native_bend(element, xi, elvis_vec3(0, 0, 1), elvis_real(1));
#endif
    elvis_vec3 u = native_transform(jacobian, hat) - elvis_fetch4_field(element, uint(NATIVE_FIELD_ROWS)).xyz;
    value = native_component(u, component);
    gradient = elvis_vec3(native_derivative(jacobian, bend1, hat, x1, component),
                          native_derivative(jacobian, bend2, hat, NATIVE_SECOND, component),
                          native_derivative(jacobian, bend3, hat, NATIVE_THIRD, component));
}
