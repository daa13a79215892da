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
