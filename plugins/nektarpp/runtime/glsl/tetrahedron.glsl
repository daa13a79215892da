// The sum in tetrahedra: A_p(eta1) B_{p,q}(eta2) C_{p+q,r}(xi3), q <= Q - p, r <= R - p - q, r fastest, p slowest. With
// barycentric coordinates L0 .. L3, s = L0 + L1, t = s + L2, the powers of l in B and C make every factor a polynomial:
//
//   modified      [L0 | L1 | L0 L1 s^(p-2) P_{p-2}^{1,1}(eta1)] [1 | L2 t^(q-1) P_{q-1}^{2p-1,1}(eta2)] [1 | L3 P_{r-1}^{2(p+q)-1,1}(xi3)]
//                 with P_{q-2}^{1,1} for p = 0 and P_{r-2}^{1,1} for p = q = 0
//   orthogonal    s^p P_p(eta1) t^q P_q^{2p+1,0}(eta2) P_r^{2(p+q)+2,0}(xi3)
//
// In the modified basis mode (0, 0, 1) is L3, and modes (0, 1, r) are L2 [1 | L3 P_{r-1}^{1,1}(xi3)]. Loops as in prism.glsl.

NEKTAR_FUNCTION {
    NEKTAR_BEGIN
    elvis_real s = (-xi.y - xi.z) * elvis_real(0.5LF), t = (elvis_real(1) - xi.z) * elvis_real(0.5LF);
    elvis_real right = (elvis_real(1) + xi.x) * elvis_real(0.5LF), left = s - right, up = (elvis_real(1) + xi.y) * elvis_real(0.5LF);
    NEKTAR_JET a[NEKTAR_P + 1], b[NEKTAR_P + 1][NEKTAR_Q + 1], c[NEKTAR_Q + 1][NEKTAR_R + 1];
    NEKTAR_COLLAPSED(NEKTAR_P, a, left, right, s)
    for (int p = 0; p <= NEKTAR_P; ++p)
        NEKTAR_MIDDLE(NEKTAR_Q, b[p], p, s, up, t)
    for (int pq = 0; pq <= NEKTAR_Q; ++pq)
        NEKTAR_LAST(NEKTAR_R, c[pq], pq, xi.z)
    int mode = 0;
    for (int p = 0; p <= NEKTAR_P; ++p) {
        // Sums over q and r, and their derivatives.
        NEKTAR_TYPE g = NEKTAR_TYPE(0), g2 = g, g3 = g, g22 = g, g23 = g, g33 = g;
        for (int q = 0; q <= NEKTAR_Q; ++q) {
            NEKTAR_TYPE h = NEKTAR_TYPE(0), h3 = h, h33 = h;
            for (int r = 0; r <= NEKTAR_R; ++r)
                if (p + q <= NEKTAR_Q && p + q + r <= NEKTAR_R) {
                    if (NEKTAR_BASIS == 1 || p > 0 || q > 1 || (q == 0 && r != 1)) {
                        NEKTAR_TYPE k = NEKTAR_COEFFICIENT(0u, mode);
                        h += k * NEKTAR_VALUE(c[p + q][r]);
                        NEKTAR_GRADIENT(h3 += k * c[p + q][r].o;)
                        NEKTAR_HESSIAN(h33 += k * c[p + q][r].oo;)
                    }
                    ++mode;
                }
            g += h * NEKTAR_VALUE(b[p][q]);
            NEKTAR_GRADIENT(g2 += h * b[p][q].o; g3 += h * b[p][q].l + h3 * b[p][q].v;)
            NEKTAR_HESSIAN(g22 += h * b[p][q].oo; g23 += h * b[p][q].ol + h3 * b[p][q].o;
                           g33 += h * b[p][q].ll + elvis_real(2) * h3 * b[p][q].l + h33 * b[p][q].v;)
        }
        f += g * NEKTAR_VALUE(a[p]);
        NEKTAR_GRADIENT(f1 += g * a[p].o; f2 += g * a[p].l + g2 * a[p].v; f3 += g * a[p].l + g3 * a[p].v;)
        NEKTAR_HESSIAN(f11 += g * a[p].oo; f12 += g * a[p].ol + g2 * a[p].o; f13 += g * a[p].ol + g3 * a[p].o;
                       f22 += g * a[p].ll + elvis_real(2) * g2 * a[p].l + g22 * a[p].v;
                       f23 += g * a[p].ll + (g2 + g3) * a[p].l + g23 * a[p].v;
                       f33 += g * a[p].ll + elvis_real(2) * g3 * a[p].l + g33 * a[p].v;)
    }
#if NEKTAR_BASIS == 0
    NEKTAR_TYPE top = NEKTAR_COEFFICIENT(0u, 1);
    NEKTAR_TYPE e = NEKTAR_TYPE(0), e3 = e, e33 = e;
    for (int r = 0; r <= NEKTAR_R; ++r)
        if (r < NEKTAR_R) {
            NEKTAR_TYPE k = NEKTAR_COEFFICIENT(0u, NEKTAR_R + 1 + r);
            e += k * NEKTAR_VALUE(c[1][r]);
            NEKTAR_GRADIENT(e3 += k * c[1][r].o;)
            NEKTAR_HESSIAN(e33 += k * c[1][r].oo;)
        }
    f += top * ((elvis_real(1) + xi.z) * elvis_real(0.5LF)) + e * up;
    NEKTAR_GRADIENT(f2 += e * elvis_real(0.5LF); f3 += top * elvis_real(0.5LF) + e3 * up;)
    NEKTAR_HESSIAN(f23 += e3 * elvis_real(0.5LF); f33 += e33 * up;)
#endif
    NEKTAR_END
}
