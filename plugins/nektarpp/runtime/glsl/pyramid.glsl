// The sum in pyramids: A_p(eta1) A_q(eta2) t^e J_{k,r}(xi3), r <= R - max(p, q), r fastest, p slowest; t = (1 - xi3)/2,
// eta_d = x_d / t, x_d = xi_d + (1 + xi3)/2.
//
//   modified      J_{k,r} = [1 | L3 P_{r-1}^{2k-1,1}]   k = e = max(p, q, 1) if p < 2 or q < 2 (p = q = 0: J_{1,r-1} for r >= 2);
//                                                       else k = p + q - 1, e = p + q - 2;   L3 = (1 + xi3)/2
//   orthogonal    J_{k,r} = P_r^{2k+2,0}                k = e = p + q
//
// In the modified basis mode (0, 0, 1) is L3. Derivatives, with m_d = (1 + eta_d)/2 and d eta_d / d xi3 = m_d / t:
//
//   f1 = A_p' A_q t^(e-1) J       f3 = A_p A_q (t^e J' - e/2 t^(e-1) J) + m1 f1 + m2 f2
//   f11 = A_p'' A_q w             f12 = A_p' A_q' w,   w = t^(e-2) J
//   f13 = A_p' A_q u + m1 f11 + m2 f12,   u = t^(e-1) J' + (1 - e)/2 w
//   f33 = A_p A_q v + 2 (m1 A_p' A_q + m2 A_p A_q') u + m1^2 f11 + 2 m1 m2 f12 + m2^2 f22,
//                                         v = t^e J'' - e t^(e-1) J' + e (e-1)/4 w
//
// Nothing is divided by t but w where e = 1: functions that are not linear there have no second derivative at the apex. Where e = 0,
// A_p and A_q are 1.
#undef NEKTAR_EXPONENT
#undef NEKTAR_KIND
#undef NEKTAR_LARGEST
#undef NEKTAR_ETA_LIMIT
#if NEKTAR_BASIS == 1
#define NEKTAR_EXPONENT(p, q) ((p) + (q))
#define NEKTAR_KIND(p, q) ((p) + (q))
#define NEKTAR_LARGEST (2 * NEKTAR_P)
#else
#define NEKTAR_EXPONENT(p, q) (min(p, q) >= 2 ? (p) + (q) - 2 : max(max(p, q), 1))
#define NEKTAR_KIND(p, q) (min(p, q) >= 2 ? (p) + (q) - 1 : max(max(p, q), 1))
#define NEKTAR_LARGEST (NEKTAR_P >= 2 ? 2 * NEKTAR_P - 1 : 1)
#endif
// eta^(P+Q) stays below 1e36, where single precision ends.
#if NEKTAR_P + NEKTAR_Q <= 4
#define NEKTAR_ETA_LIMIT elvis_real(1.0e6LF)
#else
#define NEKTAR_ETA_LIMIT elvis_real(8)
#endif

NEKTAR_FUNCTION {
    NEKTAR_BEGIN
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF);
    elvis_real eta1 = nektar_eta(xi.x + elvis_real(1) - t, t, NEKTAR_ETA_LIMIT);
    elvis_real eta2 = nektar_eta(xi.y + elvis_real(1) - t, t, NEKTAR_ETA_LIMIT);
    NEKTAR_JET a[NEKTAR_P + 1], b[NEKTAR_Q + 1], c[NEKTAR_LARGEST + 1][NEKTAR_R + 1];
    elvis_real power[NEKTAR_LARGEST + 1];
    NEKTAR_DIRECTION(NEKTAR_P, a, eta1, nektar_nodes_p, nektar_scales_p)
    NEKTAR_DIRECTION(NEKTAR_Q, b, eta2, nektar_nodes_q, nektar_scales_q)
    elvis_real power_now = elvis_real(1);
    for (int k = 0; k <= NEKTAR_LARGEST; ++k) {
        power[k] = power_now;
        power_now *= t;
        NEKTAR_LAST(NEKTAR_R, c[k], k, xi.z)
    }
    elvis_real m1 = (elvis_real(1) + eta1) * elvis_real(0.5LF), m2 = (elvis_real(1) + eta2) * elvis_real(0.5LF);
    elvis_real per_t = elvis_real(1) / (abs(t) < elvis_real(1.0e-15LF) ? elvis_real(1.0e-15LF) : t);
    // Sums of u with one derivative of A, and of v.
    NEKTAR_TYPE u1 = NEKTAR_TYPE(0), u2 = u1, v = u1;
    int mode = 0;
    for (int p = 0; p <= NEKTAR_P; ++p) {
        NEKTAR_TYPE f_p = NEKTAR_TYPE(0), f3_p = f_p, g_p = f_p, g2_p = f_p, w_p = f_p, w2_p = f_p, w22_p = f_p, u_p = f_p, u2_p = f_p;
        NEKTAR_TYPE v_p = f_p;
        for (int q = 0; q <= NEKTAR_Q; ++q) {
            const int e = NEKTAR_EXPONENT(p, q), kind = NEKTAR_KIND(p, q);
            const int shift = NEKTAR_BASIS != 1 && p + q == 0 ? 1 : 0;
            NEKTAR_TYPE h = NEKTAR_TYPE(0), h3 = h, h33 = h;
            for (int r = 0; r <= NEKTAR_R; ++r)
                if (max(p, q) + r <= NEKTAR_R) {
                    if (shift == 0 || r != 1) {
                        const int at = r == 0 ? 0 : r - shift;
                        NEKTAR_TYPE k = NEKTAR_COEFFICIENT(0u, mode);
                        h += k * NEKTAR_VALUE(c[kind][at]);
                        NEKTAR_GRADIENT(h3 += k * c[kind][at].o;)
                        NEKTAR_HESSIAN(h33 += k * c[kind][at].oo;)
                    }
                    ++mode;
                }
            f_p += power[e] * h * NEKTAR_VALUE(b[q]);
            NEKTAR_GRADIENT(NEKTAR_TYPE g = e == 0 ? NEKTAR_TYPE(0) : power[max(e - 1, 0)] * h;
                            g_p += g * b[q].v; g2_p += g * b[q].o;
                            f3_p += (power[e] * h3 - elvis_real(0.5LF) * elvis_real(e) * g) * b[q].v;)
            NEKTAR_HESSIAN(NEKTAR_TYPE w = e == 0 ? NEKTAR_TYPE(0) : e == 1 ? per_t * h : power[max(e - 2, 0)] * h;
                           NEKTAR_TYPE g3 = e == 0 ? NEKTAR_TYPE(0) : power[max(e - 1, 0)] * h3;
                           NEKTAR_TYPE u = g3 + elvis_real(0.5LF) * elvis_real(1 - e) * w;
                           w_p += w * b[q].v; w2_p += w * b[q].o; w22_p += w * b[q].oo;
                           u_p += u * b[q].v; u2_p += u * b[q].o;
                           v_p += (power[e] * h33 - elvis_real(e) * g3 + elvis_real(0.25LF) * elvis_real(e * (e - 1)) * w) * b[q].v;)
        }
        f += f_p * NEKTAR_VALUE(a[p]);
        NEKTAR_GRADIENT(f1 += g_p * a[p].o; f2 += g2_p * a[p].v; f3 += (f3_p + g2_p * m2) * a[p].v + g_p * a[p].o * m1;)
        NEKTAR_HESSIAN(f11 += w_p * a[p].oo; f12 += w2_p * a[p].o; f22 += w22_p * a[p].v;
                       u1 += u_p * a[p].o; u2 += u2_p * a[p].v; v += v_p * a[p].v;)
    }
    NEKTAR_HESSIAN(f13 = u1 + m1 * f11 + m2 * f12;
                   f23 = u2 + m1 * f12 + m2 * f22;
                   f33 = v + elvis_real(2) * (m1 * u1 + m2 * u2) + m1 * m1 * f11 + elvis_real(2) * m1 * m2 * f12 + m2 * m2 * f22;)
#if NEKTAR_BASIS == 0
    NEKTAR_TYPE top = NEKTAR_COEFFICIENT(0u, 1);
    f += top * ((elvis_real(1) + xi.z) * elvis_real(0.5LF));
    NEKTAR_GRADIENT(f3 += top * elvis_real(0.5LF);)
#endif
    NEKTAR_END
}
