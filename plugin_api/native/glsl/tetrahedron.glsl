// Tetrahedron: sum of c_pqr s^p P_p(x1/s) t^q J^{2p+1}_q(x2/t) J^{2p+2q+2}_r(xi3), q <= Q - p, r <= R - p - q;
// s = (-xi2 - xi3)/2, x1 = 1 + xi1 - s, t = (1 - xi3)/2, x2 = 1 + xi2 - t.
// One slab, p outermost, r fastest. Loops as in prism.glsl.

NATIVE_TYPE NATIVE_VALUE(uint element, uint first_row, elvis_vec3 xi) {
    elvis_real s = (-xi.y - xi.z) * elvis_real(0.5LF), x1 = xi.x + elvis_real(1) - s;
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF), x2 = xi.y + elvis_real(1) - t;
    elvis_real a[NATIVE_P + 1], b[NATIVE_P + 1][NATIVE_Q + 1], c[NATIVE_Q + 1][NATIVE_R + 1];
    NATIVE_SCALED(NATIVE_P, native_legendre(n), x1, s, a)
    for (int p = 0; p <= NATIVE_P; ++p)
        NATIVE_SCALED(NATIVE_Q, native_jacobi(2 * p + 1, n), x2, t, b[p])
    for (int pq = 0; pq <= NATIVE_Q; ++pq)
        NATIVE_SCALED(NATIVE_R, native_jacobi(2 * pq + 2, n), xi.z, elvis_real(1), c[pq])
    NATIVE_TYPE f = NATIVE_TYPE(0);
    int mode = 0;
    for (int p = 0; p <= NATIVE_P; ++p) {
        NATIVE_TYPE f_p = NATIVE_TYPE(0);
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE f_pq = NATIVE_TYPE(0);
            for (int r = 0; r <= NATIVE_R; ++r)
                if (p + q <= NATIVE_Q && p + q + r <= NATIVE_R) {
                    f_pq += NATIVE_COEFFICIENT(first_row, mode) * c[p + q][r];
                    ++mode;
                }
            f_p += f_pq * b[p][q];
        }
        f += f_p * a[p];
    }
    return f;
}

void NATIVE_GRADIENT(uint element, uint first_row, elvis_vec3 xi, out NATIVE_TYPE f, out NATIVE_TYPE f1, out NATIVE_TYPE f2,
                     out NATIVE_TYPE f3) {
    elvis_real s = (-xi.y - xi.z) * elvis_real(0.5LF), x1 = xi.x + elvis_real(1) - s;
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF), x2 = xi.y + elvis_real(1) - t;
    // a_later: derivative along xi2 and along xi3.
    elvis_real a[NATIVE_P + 1], a1[NATIVE_P + 1], a_later[NATIVE_P + 1];
    elvis_real b[NATIVE_P + 1][NATIVE_Q + 1], b2[NATIVE_P + 1][NATIVE_Q + 1], b3[NATIVE_P + 1][NATIVE_Q + 1];
    elvis_real c[NATIVE_Q + 1][NATIVE_R + 1], c3[NATIVE_Q + 1][NATIVE_R + 1];
    NATIVE_SCALED_SLOPES(NATIVE_P, native_legendre(n), x1, s, a, a1, a_later)
    for (int p = 0; p <= NATIVE_P; ++p)
        NATIVE_SCALED_SLOPES(NATIVE_Q, native_jacobi(2 * p + 1, n), x2, t, b[p], b2[p], b3[p])
    for (int pq = 0; pq <= NATIVE_Q; ++pq)
        NATIVE_PLAIN_SLOPES(NATIVE_R, native_jacobi(2 * pq + 2, n), xi.z, c[pq], c3[pq])
    f = NATIVE_TYPE(0);
    f1 = NATIVE_TYPE(0);
    f2 = NATIVE_TYPE(0);
    f3 = NATIVE_TYPE(0);
    int mode = 0;
    for (int p = 0; p <= NATIVE_P; ++p) {
        NATIVE_TYPE f_p = NATIVE_TYPE(0), f2_p = NATIVE_TYPE(0), f3_p = NATIVE_TYPE(0);
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE f_pq = NATIVE_TYPE(0), f3_pq = NATIVE_TYPE(0);
            for (int r = 0; r <= NATIVE_R; ++r)
                if (p + q <= NATIVE_Q && p + q + r <= NATIVE_R) {
                    NATIVE_TYPE k = NATIVE_COEFFICIENT(first_row, mode);
                    f_pq += k * c[p + q][r];
                    f3_pq += k * c3[p + q][r];
                    ++mode;
                }
            f_p += f_pq * b[p][q];
            f2_p += f_pq * b2[p][q];
            f3_p += f_pq * b3[p][q] + f3_pq * b[p][q];
        }
        f += f_p * a[p];
        f1 += f_p * a1[p];
        f2 += f_p * a_later[p] + f2_p * a[p];
        f3 += f_p * a_later[p] + f3_p * a[p];
    }
}

#if ELVIS_WANTS_HESSIANS
void NATIVE_HESSIAN(uint element, uint first_row, elvis_vec3 xi, out NATIVE_TYPE f, out NATIVE_TYPE f1, out NATIVE_TYPE f2,
                    out NATIVE_TYPE f3, out NATIVE_TYPE f11, out NATIVE_TYPE f22, out NATIVE_TYPE f33, out NATIVE_TYPE f23,
                    out NATIVE_TYPE f13, out NATIVE_TYPE f12) {
    const NATIVE_TYPE zero = NATIVE_TYPE(0);
    f = f1 = f2 = f3 = f11 = f22 = f33 = f23 = f13 = f12 = zero;
    elvis_real s = (-xi.y - xi.z) * elvis_real(0.5LF), x1 = xi.x + elvis_real(1) - s;
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF), x2 = xi.y + elvis_real(1) - t;
    // Index l ("later"): derivative along xi2 and along xi3, which are the same for a.
    elvis_real a[NATIVE_P + 1], a1[NATIVE_P + 1], al[NATIVE_P + 1], a11[NATIVE_P + 1], a1l[NATIVE_P + 1], all[NATIVE_P + 1];
    elvis_real b[NATIVE_P + 1][NATIVE_Q + 1], b2[NATIVE_P + 1][NATIVE_Q + 1], b3[NATIVE_P + 1][NATIVE_Q + 1];
    elvis_real b22[NATIVE_P + 1][NATIVE_Q + 1], b23[NATIVE_P + 1][NATIVE_Q + 1], b33[NATIVE_P + 1][NATIVE_Q + 1];
    elvis_real c[NATIVE_Q + 1][NATIVE_R + 1], c3[NATIVE_Q + 1][NATIVE_R + 1], c33[NATIVE_Q + 1][NATIVE_R + 1];
    NATIVE_SCALED_CURVES(NATIVE_P, native_legendre(n), x1, s, a, a1, al, a11, a1l, all)
    for (int p = 0; p <= NATIVE_P; ++p)
        NATIVE_SCALED_CURVES(NATIVE_Q, native_jacobi(2 * p + 1, n), x2, t, b[p], b2[p], b3[p], b22[p], b23[p], b33[p])
    for (int pq = 0; pq <= NATIVE_Q; ++pq)
        NATIVE_PLAIN_CURVES(NATIVE_R, native_jacobi(2 * pq + 2, n), xi.z, c[pq], c3[pq], c33[pq])
    int mode = 0;
    for (int p = 0; p <= NATIVE_P; ++p) {
        NATIVE_TYPE g = zero, g2 = zero, g3 = zero, g22 = zero, g23 = zero, g33 = zero;
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE f_pq = zero, f3_pq = zero, f33_pq = zero;
            for (int r = 0; r <= NATIVE_R; ++r)
                if (p + q <= NATIVE_Q && p + q + r <= NATIVE_R) {
                    NATIVE_TYPE k = NATIVE_COEFFICIENT(first_row, mode);
                    f_pq += k * c[p + q][r];
                    f3_pq += k * c3[p + q][r];
                    f33_pq += k * c33[p + q][r];
                    ++mode;
                }
            g += f_pq * b[p][q];
            g2 += f_pq * b2[p][q];
            g3 += f_pq * b3[p][q] + f3_pq * b[p][q];
            g22 += f_pq * b22[p][q];
            g23 += f_pq * b23[p][q] + f3_pq * b2[p][q];
            g33 += f_pq * b33[p][q] + elvis_real(2) * f3_pq * b3[p][q] + f33_pq * b[p][q];
        }
        f += g * a[p];
        f1 += g * a1[p];
        f2 += g * al[p] + g2 * a[p];
        f3 += g * al[p] + g3 * a[p];
        f11 += g * a11[p];
        f12 += g * a1l[p] + g2 * a1[p];
        f13 += g * a1l[p] + g3 * a1[p];
        f22 += g * all[p] + elvis_real(2) * g2 * al[p] + g22 * a[p];
        f23 += g * all[p] + (g2 + g3) * al[p] + g23 * a[p];
        f33 += g * all[p] + elvis_real(2) * g3 * al[p] + g33 * a[p];
    }
}
#endif
