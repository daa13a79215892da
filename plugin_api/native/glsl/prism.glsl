// Prism: sum of c_pqr t^p P_p(x1/t) T_q(xi2) J^{2p+1}_r(xi3), r <= R - p; x1 = xi1 + (1 + xi3)/2, t = (1 - xi3)/2.
// A slab holds one q; in it p is outer, r fastest.
//
// Loops run over all r and skip those beyond R - p: bounds that depend on another index would keep compilers from unrolling.

NATIVE_TYPE NATIVE_VALUE(uint element, uint first_row, elvis_vec3 xi) {
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF);
    elvis_real x1 = xi.x + elvis_real(1) - t;
    elvis_real a[NATIVE_P + 1], b[NATIVE_Q + 1], c[NATIVE_P + 1][NATIVE_R + 1];
    NATIVE_SCALED(NATIVE_P, native_legendre(n), x1, t, a)
    NATIVE_CHEBYSHEV(NATIVE_Q, xi.y, b)
    for (int p = 0; p <= NATIVE_P; ++p)
        NATIVE_SCALED(NATIVE_R, native_jacobi(2 * p + 1, n), xi.z, elvis_real(1), c[p])
    NATIVE_TYPE f = NATIVE_TYPE(0);
    for (int q = 0; q <= NATIVE_Q; ++q) {
        uint row = first_row + uint(q * NATIVE_SLAB_ROWS);
        int mode = 0;
        NATIVE_TYPE f_q = NATIVE_TYPE(0);
        for (int p = 0; p <= NATIVE_P; ++p) {
            NATIVE_TYPE f_pq = NATIVE_TYPE(0);
            for (int r = 0; r <= NATIVE_R; ++r)
                if (p + r <= NATIVE_R) {
                    f_pq += NATIVE_COEFFICIENT(row, mode) * c[p][r];
                    ++mode;
                }
            f_q += f_pq * a[p];
        }
        f += f_q * b[q];
    }
    return f;
}

void NATIVE_GRADIENT(uint element, uint first_row, elvis_vec3 xi, out NATIVE_TYPE f, out NATIVE_TYPE f1, out NATIVE_TYPE f2,
                     out NATIVE_TYPE f3) {
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF);
    elvis_real x1 = xi.x + elvis_real(1) - t;
    elvis_real a[NATIVE_P + 1], a1[NATIVE_P + 1], a3[NATIVE_P + 1];
    elvis_real b[NATIVE_Q + 1], b2[NATIVE_Q + 1];
    elvis_real c[NATIVE_P + 1][NATIVE_R + 1], c3[NATIVE_P + 1][NATIVE_R + 1];
    NATIVE_SCALED_SLOPES(NATIVE_P, native_legendre(n), x1, t, a, a1, a3)
    NATIVE_CHEBYSHEV_SLOPES(NATIVE_Q, xi.y, b, b2)
    for (int p = 0; p <= NATIVE_P; ++p)
        NATIVE_PLAIN_SLOPES(NATIVE_R, native_jacobi(2 * p + 1, n), xi.z, c[p], c3[p])
    f = NATIVE_TYPE(0);
    f1 = NATIVE_TYPE(0);
    f2 = NATIVE_TYPE(0);
    f3 = NATIVE_TYPE(0);
    for (int q = 0; q <= NATIVE_Q; ++q) {
        uint row = first_row + uint(q * NATIVE_SLAB_ROWS);
        int mode = 0;
        NATIVE_TYPE f_q = NATIVE_TYPE(0), f1_q = NATIVE_TYPE(0), f3_q = NATIVE_TYPE(0);
        for (int p = 0; p <= NATIVE_P; ++p) {
            NATIVE_TYPE f_pq = NATIVE_TYPE(0), f3_pq = NATIVE_TYPE(0);
            for (int r = 0; r <= NATIVE_R; ++r)
                if (p + r <= NATIVE_R) {
                    NATIVE_TYPE k = NATIVE_COEFFICIENT(row, mode);
                    f_pq += k * c[p][r];
                    f3_pq += k * c3[p][r];
                    ++mode;
                }
            f_q += f_pq * a[p];
            f1_q += f_pq * a1[p];
            f3_q += f_pq * a3[p] + f3_pq * a[p];
        }
        f += f_q * b[q];
        f1 += f1_q * b[q];
        f2 += f_q * b2[q];
        f3 += f3_q * b[q];
    }
}

#if ELVIS_WANTS_HESSIANS
void NATIVE_HESSIAN(uint element, uint first_row, elvis_vec3 xi, out NATIVE_TYPE f, out NATIVE_TYPE f1, out NATIVE_TYPE f2,
                    out NATIVE_TYPE f3, out NATIVE_TYPE f11, out NATIVE_TYPE f22, out NATIVE_TYPE f33, out NATIVE_TYPE f23,
                    out NATIVE_TYPE f13, out NATIVE_TYPE f12) {
    const NATIVE_TYPE zero = NATIVE_TYPE(0);
    f = f1 = f2 = f3 = f11 = f22 = f33 = f23 = f13 = f12 = zero;
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF);
    elvis_real x1 = xi.x + elvis_real(1) - t;
    elvis_real a[NATIVE_P + 1], a1[NATIVE_P + 1], a3[NATIVE_P + 1], a11[NATIVE_P + 1], a13[NATIVE_P + 1], a33[NATIVE_P + 1];
    elvis_real b[NATIVE_Q + 1], b2[NATIVE_Q + 1], b22[NATIVE_Q + 1];
    elvis_real c[NATIVE_P + 1][NATIVE_R + 1], c3[NATIVE_P + 1][NATIVE_R + 1], c33[NATIVE_P + 1][NATIVE_R + 1];
    NATIVE_SCALED_CURVES(NATIVE_P, native_legendre(n), x1, t, a, a1, a3, a11, a13, a33)
    NATIVE_PLAIN_CURVES(NATIVE_Q, native_chebyshev(n), xi.y, b, b2, b22)
    for (int p = 0; p <= NATIVE_P; ++p)
        NATIVE_PLAIN_CURVES(NATIVE_R, native_jacobi(2 * p + 1, n), xi.z, c[p], c3[p], c33[p])
    for (int q = 0; q <= NATIVE_Q; ++q) {
        uint row = first_row + uint(q * NATIVE_SLAB_ROWS);
        int mode = 0;
        NATIVE_TYPE f_q = zero, f1_q = zero, f3_q = zero, f11_q = zero, f13_q = zero, f33_q = zero;
        for (int p = 0; p <= NATIVE_P; ++p) {
            NATIVE_TYPE f_pq = zero, f3_pq = zero, f33_pq = zero;
            for (int r = 0; r <= NATIVE_R; ++r)
                if (p + r <= NATIVE_R) {
                    NATIVE_TYPE k = NATIVE_COEFFICIENT(row, mode);
                    f_pq += k * c[p][r];
                    f3_pq += k * c3[p][r];
                    f33_pq += k * c33[p][r];
                    ++mode;
                }
            f_q += f_pq * a[p];
            f1_q += f_pq * a1[p];
            f3_q += f_pq * a3[p] + f3_pq * a[p];
            f11_q += f_pq * a11[p];
            f13_q += f_pq * a13[p] + f3_pq * a1[p];
            f33_q += f_pq * a33[p] + elvis_real(2) * f3_pq * a3[p] + f33_pq * a[p];
        }
        f += f_q * b[q];
        f1 += f1_q * b[q];
        f2 += f_q * b2[q];
        f3 += f3_q * b[q];
        f11 += f11_q * b[q];
        f22 += f_q * b22[q];
        f33 += f33_q * b[q];
        f23 += f3_q * b2[q];
        f13 += f13_q * b[q];
        f12 += f1_q * b2[q];
    }
}
#endif
