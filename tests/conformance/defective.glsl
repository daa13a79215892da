// Two hexahedra of quadratic shape, x = place + (xi1, xi2 + 0.2 xi1^2, xi3 + 0.1 xi1^2 xi2), and the field s (xi1^2 + xi2 xi3).
// DEFECTIVE_DEFECT is the number of a defect in the list of defective.cpp; 0: none.

elvis_vec3 defective_place(uint element) { return elvis_fetch4_place(element, 0u).xyz; }

#if DEFECTIVE_DEFECT == 1
elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return defective_place(element) + xi }
#elif DEFECTIVE_DEFECT == 3
elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    vec3 x = xi;
    return defective_place(element) + x;
}
#elif DEFECTIVE_DEFECT == 4
elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    float fifth = 0.2;
    float tenth = 0.1;
    return defective_place(element) +
           elvis_vec3(xi.x, xi.y + elvis_real(fifth) * xi.x * xi.x, xi.z + elvis_real(tenth) * xi.x * xi.x * xi.y);
}
#else
elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    elvis_real square = xi.x * xi.x;
#if DEFECTIVE_DEFECT == 15
    square += abs(xi.x) > elvis_real(1) ? sqrt(elvis_real(1) - square) : elvis_real(0);
#endif
    return defective_place(element) + elvis_vec3(xi.x, xi.y + elvis_real(0.2LF) * square, xi.z + elvis_real(0.1LF) * square * xi.y);
}
#endif

elvis_mat3 defective_jacobian(elvis_vec3 xi) {
    return elvis_mat3(elvis_vec3(1, elvis_real(0.4LF) * xi.x, elvis_real(0.2LF) * xi.x * xi.y),
                      elvis_vec3(0, 1, elvis_real(0.1LF) * xi.x * xi.x), elvis_vec3(0, 0, 1));
}

elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
#if DEFECTIVE_DEFECT == 6
    return transpose(defective_jacobian(xi));
#else
    return defective_jacobian(xi);
#endif
}

void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    x = elvis_mapping(element, xi);
    jacobian = defective_jacobian(xi);
#if DEFECTIVE_DEFECT == 7
    jacobian[1].x += elvis_real(0.01LF);
#elif DEFECTIVE_DEFECT == 13
    jacobian = -jacobian;
#endif
}

bool elvis_inverse_mapping(uint element, elvis_vec3 x, out elvis_vec3 xi) {
    elvis_vec3 d = x - defective_place(element);
    elvis_real xi2 = d.y - elvis_real(0.2LF) * d.x * d.x;
    xi = elvis_vec3(d.x, xi2, d.z - elvis_real(0.1LF) * d.x * d.x * xi2);
#if DEFECTIVE_DEFECT == 11
    xi.z = d.z;
#elif DEFECTIVE_DEFECT == 12
    return false;
#endif
    return max(abs(xi.x), max(abs(xi.y), abs(xi.z))) < elvis_real(2);
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    elvis_vec4 scale = elvis_fetch4_scale(element, 0u);
    elvis_real value = scale.x * (xi.x * xi.x + xi.y * xi.z);
#if DEFECTIVE_DEFECT == 5
    value += elvis_real(0.001LF);
#elif DEFECTIVE_DEFECT == 27
    value += elvis_real(0.001LF) * elvis_real(element);
#elif DEFECTIVE_DEFECT == 14
    precise elvis_real large = elvis_real(1000000) + value;
    precise elvis_real small = large - elvis_real(1000000);
    value = small;
#elif DEFECTIVE_DEFECT == 16
    value = abs(xi.y) > elvis_real(1) ? elvis_real(0) : value;
#elif DEFECTIVE_DEFECT == 17
    elvis_real angle = xi.x;
    while (!(abs(angle) <= elvis_real(3))) {
        angle *= elvis_real(0.5LF);
    }
    value += elvis_real(0) * angle;
#elif DEFECTIVE_DEFECT == 20
    elvis_real powers[3];
    powers[0] = elvis_real(1);
    for (int i = 1; i < 3; ++i) {
        powers[i] = xi.x * powers[i - 1];
    }
    value += elvis_real(0) * powers[int(elvis_real(1.5LF) * (elvis_real(1) + xi.x))];
#elif DEFECTIVE_DEFECT == 21
    value += elvis_real(0) * elvis_fetch_scale(element, xi.x > elvis_real(0.9LF) ? 4u : 0u);
#endif
#if DEFECTIVE_DEFECT == 19
    return value;
#else
    return value - scale.y;
#endif
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    value = elvis_field_value(element, xi, component);
    elvis_real scale = elvis_fetch4_scale(element, 0u).x;
#if DEFECTIVE_DEFECT == 8
    gradient = scale * elvis_vec3(xi.x, xi.z, xi.y);
#elif DEFECTIVE_DEFECT == 18
    gradient.xy = scale * elvis_vec2(elvis_real(2) * xi.x, xi.z);
#else
    gradient = scale * elvis_vec3(elvis_real(2) * xi.x, xi.z, xi.y);
#endif
}

void elvis_field_hessian(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient,
                         out elvis_mat3 hessian) {
    elvis_field_gradient(element, xi, component, value, gradient);
    elvis_real scale = elvis_fetch4_scale(element, 0u).x;
    hessian = elvis_mat3(elvis_vec3(elvis_real(2) * scale, 0, 0), elvis_vec3(0, 0, scale), elvis_vec3(0, scale, 0));
#if DEFECTIVE_DEFECT == 9
    hessian[0].x = scale;
#endif
}

void elvis_mapping_hessian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian, out elvis_mat3 hessian_x,
                           out elvis_mat3 hessian_y, out elvis_mat3 hessian_z) {
    elvis_mapping_jacobian(element, xi, x, jacobian);
    hessian_x = elvis_mat3(0);
    hessian_y = elvis_mat3(0);
    hessian_y[0].x = elvis_real(0.4LF);
    hessian_z = elvis_mat3(0);
    hessian_z[0].x = elvis_real(0.2LF) * xi.y;
    hessian_z[0].y = elvis_real(0.2LF) * xi.x;
#if DEFECTIVE_DEFECT != 10
    hessian_z[1].x = elvis_real(0.2LF) * xi.x;
#endif
}

// Of each there is only the part 0.2 xi1^2 + xi2^2 + xi3^2 <= 2.
void elvis_inside(uint element, elvis_vec3 xi, out elvis_real g, out elvis_vec3 gradient) {
    g = elvis_real(0.2LF) * xi.x * xi.x + xi.y * xi.y + xi.z * xi.z - elvis_real(2);
#if DEFECTIVE_DEFECT == 24
    // The two have different parts of the face that they share.
    g += element == 0u ? elvis_real(0) : elvis_real(1);
#elif DEFECTIVE_DEFECT == 25
    g += elvis_real(3);
#endif
#if DEFECTIVE_DEFECT == 22
    gradient = elvis_vec3(elvis_real(0.4LF) * xi.x, xi.y, elvis_real(2) * xi.z);
#elif DEFECTIVE_DEFECT == 26
    gradient.xy = elvis_vec2(elvis_real(0.4LF) * xi.x, elvis_real(2) * xi.y);
#else
    gradient = elvis_vec3(elvis_real(0.4LF) * xi.x, elvis_real(2) * xi.y, elvis_real(2) * xi.z);
#endif
}

elvis_vec2 elvis_inside_bounds(uint element) {
#if DEFECTIVE_DEFECT == 23
    return elvis_vec2(elvis_real(4.5LF), elvis_real(0.5LF));
#else
    return elvis_vec2(elvis_real(4.5LF), elvis_real(4.5LF));
#endif
}
