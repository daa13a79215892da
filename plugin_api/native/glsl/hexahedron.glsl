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

#if ELVIS_WANTS_HESSIANS
void NATIVE_HESSIAN(uint element, uint first_row, elvis_vec3 xi, out NATIVE_TYPE f, out NATIVE_TYPE f1, out NATIVE_TYPE f2,
                    out NATIVE_TYPE f3, out NATIVE_TYPE f11, out NATIVE_TYPE f22, out NATIVE_TYPE f33, out NATIVE_TYPE f23,
                    out NATIVE_TYPE f13, out NATIVE_TYPE f12) {
    const NATIVE_TYPE zero = NATIVE_TYPE(0);
    f = f1 = f2 = f3 = f11 = f22 = f33 = f23 = f13 = f12 = zero;
    elvis_real a[NATIVE_P + 1], b[NATIVE_Q + 1], c[NATIVE_R + 1];
    elvis_real a1[NATIVE_P + 1], b2[NATIVE_Q + 1], c3[NATIVE_R + 1];
    elvis_real a11[NATIVE_P + 1], b22[NATIVE_Q + 1], c33[NATIVE_R + 1];
    NATIVE_PLAIN_CURVES(NATIVE_P, native_chebyshev(n), xi.x, a, a1, a11)
    NATIVE_PLAIN_CURVES(NATIVE_Q, native_chebyshev(n), xi.y, b, b2, b22)
    NATIVE_PLAIN_CURVES(NATIVE_R, native_chebyshev(n), xi.z, c, c3, c33)
    for (int r = 0; r <= NATIVE_R; ++r) {
        uint row = first_row + uint(r * NATIVE_SLAB_ROWS);
        NATIVE_TYPE f_r = zero, f1_r = zero, f2_r = zero, f11_r = zero, f12_r = zero, f22_r = zero;
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE f_qr = zero, f1_qr = zero, f11_qr = zero;
            for (int p = 0; p <= NATIVE_P; ++p) {
                NATIVE_TYPE k = NATIVE_COEFFICIENT(row, q * (NATIVE_P + 1) + p);
                f_qr += k * a[p];
                f1_qr += k * a1[p];
                f11_qr += k * a11[p];
            }
            f_r += f_qr * b[q];
            f1_r += f1_qr * b[q];
            f11_r += f11_qr * b[q];
            f2_r += f_qr * b2[q];
            f12_r += f1_qr * b2[q];
            f22_r += f_qr * b22[q];
        }
        f += f_r * c[r];
        f1 += f1_r * c[r];
        f2 += f2_r * c[r];
        f3 += f_r * c3[r];
        f11 += f11_r * c[r];
        f12 += f12_r * c[r];
        f22 += f22_r * c[r];
        f13 += f1_r * c3[r];
        f23 += f2_r * c3[r];
        f33 += f_r * c33[r];
    }
}
#endif
