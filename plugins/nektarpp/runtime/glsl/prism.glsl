// The sum in prisms: A_p(eta1) A_q(xi2) B_{p,r}(xi3), r <= R - p, r fastest, p slowest. With L0 = l(eta1) t, L1 = r(eta1) t,
// t = (1 - xi3)/2, L3 = (1 + xi3)/2 the factor t^p (t for p = 0) of B makes A_p a polynomial in L0 and L1:
//
//   modified      [L0 | L1 | L0 L1 t^(p-2) P_{p-2}^{1,1}(eta1)] A_q(xi2) [1 | L3 P_{r-1}^{2p-1,1}(xi3)],   p = 0: L3 P_{r-2}^{1,1}
//   orthogonal    t^p P_p(eta1) P_q(xi2) P_r^{2p+1,0}(xi3)
//
// In the modified basis mode (0, q, 1) is A_q L3. In triangles Q = 0. Loops run over all r and skip those beyond R - p: bounds that
// depend on another index would keep compilers from unrolling.

NEKTAR_FUNCTION {
    NEKTAR_BEGIN
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF), right = (elvis_real(1) + xi.x) * elvis_real(0.5LF), left = t - right;
    NEKTAR_JET a[NEKTAR_P + 1], b[NEKTAR_Q + 1], c[NEKTAR_P + 1][NEKTAR_R + 1];
    NEKTAR_COLLAPSED(NEKTAR_P, a, left, right, t)
#if ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    b[0] = NEKTAR_CONSTANT(1);
#else
    NEKTAR_DIRECTION(NEKTAR_Q, b, xi.y, nektar_nodes_q, nektar_scales_q)
#endif
    for (int p = 0; p <= NEKTAR_P; ++p)
        NEKTAR_LAST(NEKTAR_R, c[p], p, xi.z)
    int mode = 0;
    for (int p = 0; p <= NEKTAR_P; ++p) {
        // Sums over q and r, and their derivatives.
        NEKTAR_TYPE g = NEKTAR_TYPE(0), g2 = g, g3 = g, g22 = g, g23 = g, g33 = g;
        for (int q = 0; q <= NEKTAR_Q; ++q) {
            NEKTAR_TYPE h = NEKTAR_TYPE(0), h3 = h, h33 = h;
            for (int r = 0; r <= NEKTAR_R; ++r)
                if (p + r <= NEKTAR_R) {
                    if (NEKTAR_BASIS == 1 || p > 0 || r != 1) {
                        NEKTAR_TYPE k = NEKTAR_COEFFICIENT(0u, mode);
                        h += k * NEKTAR_VALUE(c[p][r]);
                        NEKTAR_GRADIENT(h3 += k * c[p][r].o;)
                        NEKTAR_HESSIAN(h33 += k * c[p][r].oo;)
                    }
                    ++mode;
                }
            g += h * NEKTAR_VALUE(b[q]);
            NEKTAR_GRADIENT(g2 += h * b[q].o; g3 += h3 * b[q].v;)
            NEKTAR_HESSIAN(g22 += h * b[q].oo; g23 += h3 * b[q].o; g33 += h33 * b[q].v;)
        }
        f += g * NEKTAR_VALUE(a[p]);
        NEKTAR_GRADIENT(f1 += g * a[p].o; f2 += g2 * a[p].v; f3 += g * a[p].l + g3 * a[p].v;)
        NEKTAR_HESSIAN(f11 += g * a[p].oo; f12 += g2 * a[p].o; f13 += g * a[p].ol + g3 * a[p].o;
                       f22 += g22 * a[p].v; f23 += g2 * a[p].l + g23 * a[p].v;
                       f33 += g * a[p].ll + elvis_real(2) * g3 * a[p].l + g33 * a[p].v;)
    }
#if NEKTAR_BASIS == 0
    NEKTAR_TYPE e = NEKTAR_TYPE(0), e2 = e, e22 = e;
    for (int q = 0; q <= NEKTAR_Q; ++q) {
        NEKTAR_TYPE k = NEKTAR_COEFFICIENT(0u, q * (NEKTAR_R + 1) + 1);
        e += k * NEKTAR_VALUE(b[q]);
        NEKTAR_GRADIENT(e2 += k * b[q].o;)
        NEKTAR_HESSIAN(e22 += k * b[q].oo;)
    }
    elvis_real top = (elvis_real(1) + xi.z) * elvis_real(0.5LF);
    f += e * top;
    NEKTAR_GRADIENT(f2 += e2 * top; f3 += e * elvis_real(0.5LF);)
    NEKTAR_HESSIAN(f22 += e22 * top; f23 += e2 * elvis_real(0.5LF);)
#endif
    NEKTAR_END
}
