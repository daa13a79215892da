// Hexahedron: sum of c_pqr T_p(xi1) T_q(xi2) T_r(xi3). A slab holds one r, p fastest.

NATIVE_TYPE NATIVE_VALUE(uint element, uint first_row, elvis_vec3 xi) {
    elvis_real a[NATIVE_P + 1], b[NATIVE_Q + 1], c[NATIVE_R + 1];
    NATIVE_CHEBYSHEV(NATIVE_P, xi.x, a)
    NATIVE_CHEBYSHEV(NATIVE_Q, xi.y, b)
    NATIVE_CHEBYSHEV(NATIVE_R, xi.z, c)
    NATIVE_TYPE f = NATIVE_TYPE(0);
    for (int r = 0; r <= NATIVE_R; ++r) {
        uint row = first_row + uint(r * NATIVE_SLAB_ROWS);
        NATIVE_TYPE f_r = NATIVE_TYPE(0);
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE f_qr = NATIVE_TYPE(0);
            for (int p = 0; p <= NATIVE_P; ++p)
                f_qr += NATIVE_COEFFICIENT(row, q * (NATIVE_P + 1) + p) * a[p];
            f_r += f_qr * b[q];
        }
        f += f_r * c[r];
    }
    return f;
}

void NATIVE_GRADIENT(uint element, uint first_row, elvis_vec3 xi, out NATIVE_TYPE f, out NATIVE_TYPE f1, out NATIVE_TYPE f2,
                     out NATIVE_TYPE f3) {
    elvis_real a[NATIVE_P + 1], b[NATIVE_Q + 1], c[NATIVE_R + 1];
    elvis_real a1[NATIVE_P + 1], b2[NATIVE_Q + 1], c3[NATIVE_R + 1];
    NATIVE_CHEBYSHEV_SLOPES(NATIVE_P, xi.x, a, a1)
    NATIVE_CHEBYSHEV_SLOPES(NATIVE_Q, xi.y, b, b2)
    NATIVE_CHEBYSHEV_SLOPES(NATIVE_R, xi.z, c, c3)
    f = NATIVE_TYPE(0);
    f1 = NATIVE_TYPE(0);
    f2 = NATIVE_TYPE(0);
    f3 = NATIVE_TYPE(0);
    for (int r = 0; r <= NATIVE_R; ++r) {
        uint row = first_row + uint(r * NATIVE_SLAB_ROWS);
        NATIVE_TYPE f_r = NATIVE_TYPE(0), f1_r = NATIVE_TYPE(0), f2_r = NATIVE_TYPE(0);
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE f_qr = NATIVE_TYPE(0), f1_qr = NATIVE_TYPE(0);
            for (int p = 0; p <= NATIVE_P; ++p) {
                NATIVE_TYPE k = NATIVE_COEFFICIENT(row, q * (NATIVE_P + 1) + p);
                f_qr += k * a[p];
                f1_qr += k * a1[p];
            }
            f_r += f_qr * b[q];
            f1_r += f1_qr * b[q];
            f2_r += f_qr * b2[q];
        }
        f += f_r * c[r];
        f1 += f1_r * c[r];
        f2 += f2_r * c[r];
        f3 += f_r * c3[r];
    }
}
