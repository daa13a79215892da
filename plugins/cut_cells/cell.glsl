// Cells of a Cartesian grid with fields of products of Legendre polynomials.
//
// A record of `place` is the middle of the cell and its half sides, two rows; a record of `modes` has, for each component, rows of
// the coefficients of P_0 .. P_3 in the first direction, for each pair of orders in the other two, the second faster (plugin.cpp).

elvis_vec4 cutcells_legendre(elvis_real t) {
    elvis_real square = t * t;
    return elvis_vec4(elvis_real(1), t, elvis_real(0.5LF) * (elvis_real(3) * square - elvis_real(1)),
                      elvis_real(0.5LF) * t * (elvis_real(5) * square - elvis_real(3)));
}

elvis_vec4 cutcells_legendre_slopes(elvis_real t) {
    return elvis_vec4(elvis_real(0), elvis_real(1), elvis_real(3) * t, elvis_real(0.5LF) * (elvis_real(15) * t * t - elvis_real(3)));
}

// Value and gradient of the polynomial whose rows begin with number `first` of a buffer's record: FETCH is elvis_fetch4_NAME.
#define CUTCELLS_EVALUATE(FETCH, record, first, ORDER, xi, value, gradient)                                                        \
    {                                                                                                                              \
        elvis_vec4 x = cutcells_legendre(xi.x), y = cutcells_legendre(xi.y), z = cutcells_legendre(xi.z);                          \
        elvis_vec4 dx = cutcells_legendre_slopes(xi.x), dy = cutcells_legendre_slopes(xi.y);                                       \
        elvis_vec4 dz = cutcells_legendre_slopes(xi.z);                                                                            \
        elvis_real sum = elvis_real(0), sum1 = elvis_real(0), sum2 = elvis_real(0), sum3 = elvis_real(0);                          \
        uint row = first;                                                                                                          \
        for (int k = 0; k <= ORDER; ++k) {                                                                                         \
            for (int j = 0; j <= ORDER; ++j) {                                                                                     \
                elvis_vec4 c = FETCH(record, row);                                                                                 \
                row += 1u;                                                                                                         \
                elvis_real along = dot(c, x);                                                                                      \
                sum += y[j] * z[k] * along;                                                                                        \
                sum1 += y[j] * z[k] * dot(c, dx);                                                                                  \
                sum2 += dy[j] * z[k] * along;                                                                                      \
                sum3 += y[j] * dz[k] * along;                                                                                      \
            }                                                                                                                      \
        }                                                                                                                          \
        value = sum;                                                                                                               \
        gradient = elvis_vec3(sum1, sum2, sum3);                                                                                   \
    }

#define CUTCELLS_N_ROWS uint((CUTCELLS_ORDER + 1) * (CUTCELLS_ORDER + 1))

void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    elvis_vec3 middle = elvis_fetch4_place(element, 0u).xyz, half_side = elvis_fetch4_place(element, 1u).xyz;
    x = middle + half_side * xi;
    jacobian = elvis_mat3(elvis_vec3(half_side.x, 0, 0), elvis_vec3(0, half_side.y, 0), elvis_vec3(0, 0, half_side.z));
}

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    return elvis_fetch4_place(element, 0u).xyz + elvis_fetch4_place(element, 1u).xyz * xi;
}

elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, x, jacobian);
    return jacobian;
}

bool elvis_inverse_mapping(uint element, elvis_vec3 x, out elvis_vec3 xi) {
    xi = (x - elvis_fetch4_place(element, 0u).xyz) / elvis_fetch4_place(element, 1u).xyz;
    return true;
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    CUTCELLS_EVALUATE(elvis_fetch4_modes, element, component * CUTCELLS_N_ROWS, CUTCELLS_ORDER, xi, value, gradient)
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    elvis_real value;
    elvis_vec3 gradient;
    elvis_field_gradient(element, xi, component, value, gradient);
    return value;
}
