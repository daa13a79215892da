// Pyramid: sum of B_p(eta1) B_q(eta2) (c_apex + t^e sum_r c_pqr J^{2e+2}_r(xi3)), eta_d = x_d / t, t = (1 - xi3)/2,
// x_d = xi_d + (1 + xi3)/2. Only tensor spaces have c_apex for all p, q; it vanishes where the function has a single value at the
// apex, and so does then every division by t: derivatives of t^e come with t^(e-1), e >= 1.
//
// Tensor spaces: a slab holds one p, then q, r fastest. Others: one slab, p outermost, r fastest. Loops as in prism.glsl.

#ifndef NATIVE_PYRAMID
#define NATIVE_PYRAMID

// B_p: 1, eta, then (1 - eta^2)/4 P_{p-2}^{1,1}; orthogonal spaces: Legendre polynomials.
#define NATIVE_PYRAMID_FACTORS(order, eta, values, slopes)                                                                         \
    {                                                                                                                              \
        elvis_real now = elvis_real(1), before = elvis_real(0), slope = elvis_real(0), slope_before = elvis_real(0);               \
        elvis_real bubble = (elvis_real(1) - eta) * (elvis_real(1) + eta) * elvis_real(0.25LF);                                    \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            bool inner = NATIVE_BASIS != 2 && n >= 2;                                                                              \
            if (NATIVE_BASIS != 2 && n == 2) {                                                                                     \
                now = elvis_real(1);                                                                                               \
                before = slope = slope_before = elvis_real(0);                                                                     \
            }                                                                                                                      \
            values[n] = inner ? bubble * now : now;                                                                                \
            slopes[n] = inner ? bubble * slope - elvis_real(0.5LF) * eta * now : slope;                                            \
            elvis_vec3 k = inner ? native_jacobi_11(n - 2) : native_legendre(n);                                                   \
            elvis_real next = k[1] * eta * now - k[2] * before;                                                                    \
            elvis_real slope_next = k[1] * (now + eta * slope) - k[2] * slope_before;                                              \
            before = now;                                                                                                          \
            now = next;                                                                                                            \
            slope_before = slope;                                                                                                  \
            slope = slope_next;                                                                                                    \
        }                                                                                                                          \
    }

// The same with second derivatives.
#define NATIVE_PYRAMID_CURVES(order, eta, values, slopes, curves)                                                                  \
    {                                                                                                                              \
        elvis_real now = elvis_real(1), before = elvis_real(0), slope = elvis_real(0), slope_before = elvis_real(0);               \
        elvis_real curve = elvis_real(0), curve_before = elvis_real(0);                                                            \
        elvis_real bubble = (elvis_real(1) - eta) * (elvis_real(1) + eta) * elvis_real(0.25LF);                                    \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            bool inner = NATIVE_BASIS != 2 && n >= 2;                                                                              \
            if (NATIVE_BASIS != 2 && n == 2) {                                                                                     \
                now = elvis_real(1);                                                                                               \
                before = slope = slope_before = curve = curve_before = elvis_real(0);                                              \
            }                                                                                                                      \
            values[n] = inner ? bubble * now : now;                                                                                \
            slopes[n] = inner ? bubble * slope - elvis_real(0.5LF) * eta * now : slope;                                            \
            curves[n] = inner ? bubble * curve - eta * slope - elvis_real(0.5LF) * now : curve;                                    \
            elvis_vec3 k = inner ? native_jacobi_11(n - 2) : native_legendre(n);                                                   \
            elvis_real next = k[1] * eta * now - k[2] * before;                                                                    \
            elvis_real slope_next = k[1] * (now + eta * slope) - k[2] * slope_before;                                              \
            elvis_real curve_next = k[1] * (elvis_real(2) * slope + eta * curve) - k[2] * curve_before;                            \
            before = now;                                                                                                          \
            now = next;                                                                                                            \
            slope_before = slope;                                                                                                  \
            slope = slope_next;                                                                                                    \
            curve_before = curve;                                                                                                  \
            curve = curve_next;                                                                                                    \
        }                                                                                                                          \
    }

// For each e: t^(e-1) J, its derivative d(t^e J)/dxi3, and P, Q, S of NATIVE_HESSIAN.
#define NATIVE_PYRAMID_POWERS(xi3, t, per_t, c, c3, cp, cq, cs)                                                                    \
    {                                                                                                                              \
        elvis_real power = elvis_real(1), before = elvis_real(0);                                                                  \
        for (int i = 0; i < NATIVE_LARGEST_EXPONENT; ++i) {                                                                        \
            elvis_real e = elvis_real(i + 1);                                                                                      \
            NATIVE_PLAIN_CURVES(NATIVE_R, native_jacobi(2 * i + 4, n), xi3, c[i], c3[i], cs[i])                                    \
            for (int r = 0; r <= NATIVE_R; ++r) {                                                                                  \
                elvis_real j = c[i][r], j1 = c3[i][r], j2 = cs[i][r];                                                              \
                c[i][r] = power * j;                                                                                               \
                c3[i][r] = power * (t * j1 - elvis_real(0.5LF) * e * j);                                                           \
                cp[i][r] = i == 0 ? per_t * j : before * j;                                                                        \
                cq[i][r] = power * j1 + elvis_real(0.5LF) * (elvis_real(1) - e) * before * j;                                      \
                cs[i][r] = power * (t * j2 - e * j1) + elvis_real(0.25LF) * e * (e - elvis_real(1)) * before * j;                  \
            }                                                                                                                      \
            before = power;                                                                                                        \
            power *= t;                                                                                                            \
        }                                                                                                                          \
    }

// Collapsed coordinate x/t. At the apex it is -1 by convention. Far outside the pyramid, where t is small, it is kept from
// growing so large that its powers overflow.
elvis_real native_pyramid_eta(elvis_real x, elvis_real t, elvis_real limit) {
    elvis_real eta = x / (t == elvis_real(0) ? elvis_real(1) : t);
    return t == elvis_real(0) ? elvis_real(-1) : clamp(eta, -limit, limit);
}

#endif

#undef NATIVE_LARGEST_EXPONENT
#undef NATIVE_EXPONENT
#undef NATIVE_HAS_APEX
#undef NATIVE_COUNT
#undef NATIVE_ETA_LIMIT
#if NATIVE_BASIS == 0
#define NATIVE_LARGEST_EXPONENT 1
#define NATIVE_EXPONENT(p, q) 1
#define NATIVE_HAS_APEX(p, q) true
#define NATIVE_COUNT(p, q) NATIVE_R
#else
#define NATIVE_HAS_APEX(p, q) ((p) + (q) == 0)
#define NATIVE_COUNT(p, q) (NATIVE_R + 1 - max(max(p, q), 1))
#if NATIVE_BASIS == 1
#define NATIVE_LARGEST_EXPONENT (NATIVE_P > 2 ? 2 * NATIVE_P - 2 : NATIVE_P + 1)
#define NATIVE_EXPONENT(p, q) (min(p, q) >= 2 ? (p) + (q) - 2 : max(max(p, q), 1))
#else
#define NATIVE_LARGEST_EXPONENT (NATIVE_P > 0 ? 2 * NATIVE_P : 1)
#define NATIVE_EXPONENT(p, q) max((p) + (q), 1)
#endif
#endif
// eta^(P+Q) stays below 1e36, where single precision ends.
#if NATIVE_P + NATIVE_Q <= 4
#define NATIVE_ETA_LIMIT elvis_real(1.0e6LF)
#else
#define NATIVE_ETA_LIMIT elvis_real(8)
#endif

NATIVE_TYPE NATIVE_VALUE(uint element, uint first_row, elvis_vec3 xi) {
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF);
    elvis_real eta1 = native_pyramid_eta(xi.x + elvis_real(1) - t, t, NATIVE_ETA_LIMIT);
    elvis_real eta2 = native_pyramid_eta(xi.y + elvis_real(1) - t, t, NATIVE_ETA_LIMIT);
    elvis_real a[NATIVE_P + 1], a1[NATIVE_P + 1], b[NATIVE_Q + 1], b2[NATIVE_Q + 1];
    elvis_real c[NATIVE_LARGEST_EXPONENT][NATIVE_R + 1];
    NATIVE_PYRAMID_FACTORS(NATIVE_P, eta1, a, a1)
    NATIVE_PYRAMID_FACTORS(NATIVE_Q, eta2, b, b2)
    // c[e - 1][r] = t^e J_r.
    elvis_real power = t;
    for (int i = 0; i < NATIVE_LARGEST_EXPONENT; ++i) {
        NATIVE_SCALED(NATIVE_R, native_jacobi(2 * i + 4, n), xi.z, elvis_real(1), c[i])
        for (int r = 0; r <= NATIVE_R; ++r)
            c[i][r] *= power;
        power *= t;
    }
    NATIVE_TYPE f = NATIVE_TYPE(0);
    int mode = 0;
    uint row = first_row;
    for (int p = 0; p <= NATIVE_P; ++p) {
        if (NATIVE_BASIS == 0) {
            mode = 0;
            row = first_row + uint(p * NATIVE_SLAB_ROWS);
        }
        NATIVE_TYPE f_p = NATIVE_TYPE(0);
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE f_pq = NATIVE_TYPE(0);
            if (NATIVE_HAS_APEX(p, q)) {
                f_pq = NATIVE_COEFFICIENT(row, mode);
                ++mode;
            }
            for (int r = 0; r <= NATIVE_R; ++r)
                if (r < NATIVE_COUNT(p, q)) {
                    f_pq += NATIVE_COEFFICIENT(row, mode) * c[NATIVE_EXPONENT(p, q) - 1][r];
                    ++mode;
                }
            f_p += f_pq * b[q];
        }
        f += f_p * a[p];
    }
    return f;
}

void NATIVE_GRADIENT(uint element, uint first_row, elvis_vec3 xi, out NATIVE_TYPE f, out NATIVE_TYPE f1, out NATIVE_TYPE f2,
                     out NATIVE_TYPE f3) {
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF);
    elvis_real eta1 = native_pyramid_eta(xi.x + elvis_real(1) - t, t, NATIVE_ETA_LIMIT);
    elvis_real eta2 = native_pyramid_eta(xi.y + elvis_real(1) - t, t, NATIVE_ETA_LIMIT);
    elvis_real a[NATIVE_P + 1], a1[NATIVE_P + 1], b[NATIVE_Q + 1], b2[NATIVE_Q + 1];
    elvis_real c[NATIVE_LARGEST_EXPONENT][NATIVE_R + 1], c3[NATIVE_LARGEST_EXPONENT][NATIVE_R + 1];
    NATIVE_PYRAMID_FACTORS(NATIVE_P, eta1, a, a1)
    NATIVE_PYRAMID_FACTORS(NATIVE_Q, eta2, b, b2)
    // c[e - 1][r] = t^(e-1) J_r; c3: d(t^e J_r)/dxi3 = t^(e-1) (t J_r' - e/2 J_r).
    elvis_real power = elvis_real(1);
    for (int i = 0; i < NATIVE_LARGEST_EXPONENT; ++i) {
        NATIVE_PLAIN_SLOPES(NATIVE_R, native_jacobi(2 * i + 4, n), xi.z, c[i], c3[i])
        for (int r = 0; r <= NATIVE_R; ++r) {
            c3[i][r] = power * (t * c3[i][r] - elvis_real(0.5LF) * elvis_real(i + 1) * c[i][r]);
            c[i][r] *= power;
        }
        power *= t;
    }
    // d eta_d / d xi_d = 1/t, d eta_d / d xi3 = (1 + eta_d) / (2t).
    elvis_real drift1 = (elvis_real(1) + eta1) * elvis_real(0.5LF), drift2 = (elvis_real(1) + eta2) * elvis_real(0.5LF);
    elvis_real per_t = elvis_real(1) / (abs(t) < elvis_real(1.0e-20LF) ? elvis_real(1.0e-20LF) : t);
    f = NATIVE_TYPE(0);
    f1 = NATIVE_TYPE(0);
    f2 = NATIVE_TYPE(0);
    f3 = NATIVE_TYPE(0);
    int mode = 0;
    uint row = first_row;
    for (int p = 0; p <= NATIVE_P; ++p) {
        if (NATIVE_BASIS == 0) {
            mode = 0;
            row = first_row + uint(p * NATIVE_SLAB_ROWS);
        }
        // Sums over q: of the function; of it divided by t (g), with B_q and with B_q'; of its derivative at constant eta.
        NATIVE_TYPE f_p = NATIVE_TYPE(0), g_p = NATIVE_TYPE(0), g2_p = NATIVE_TYPE(0), f3_p = NATIVE_TYPE(0);
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE f_pq = NATIVE_TYPE(0), g_pq = NATIVE_TYPE(0), f3_pq = NATIVE_TYPE(0);
            if (NATIVE_HAS_APEX(p, q)) {
                f_pq = NATIVE_COEFFICIENT(row, mode);
                ++mode;
            }
            for (int r = 0; r <= NATIVE_R; ++r)
                if (r < NATIVE_COUNT(p, q)) {
                    NATIVE_TYPE k = NATIVE_COEFFICIENT(row, mode);
                    g_pq += k * c[NATIVE_EXPONENT(p, q) - 1][r];
                    f3_pq += k * c3[NATIVE_EXPONENT(p, q) - 1][r];
                    ++mode;
                }
            NATIVE_TYPE apex = f_pq;
            f_pq += g_pq * t;
            g_pq += apex * per_t;
            f_p += f_pq * b[q];
            g_p += g_pq * b[q];
            g2_p += g_pq * b2[q];
            f3_p += f3_pq * b[q];
        }
        f += f_p * a[p];
        f1 += g_p * a1[p];
        f2 += g2_p * a[p];
        f3 += (f3_p + g2_p * drift2) * a[p] + g_p * a1[p] * drift1;
    }
}

#if ELVIS_WANTS_HESSIANS
// Second derivatives. With h = B_p B_q t^e J, m_d = (1 + eta_d)/2 and d eta_d / d xi3 = m_d / t:
//     f11 = P B_p'' B_q, f12 = P B_p' B_q', f22 = P B_p B_q'',            P = t^(e-2) J
//     f13 = Q B_p' B_q + m1 f11 + m2 f12, f23 likewise,                   Q = t^(e-1) J' + (1 - e)/2 t^(e-2) J
//     f33 = S B_p B_q + 2 Q (m1 B_p' B_q + m2 B_p B_q') + m1^2 f11 + 2 m1 m2 f12 + m2^2 f22,
//                                                                         S = t^e J'' - e t^(e-1) J' + e (e-1)/4 t^(e-2) J
// so that t^(e-2) with e = 1 stands only where a function is not linear in x1, x2 and t: those have no second derivative at the
// apex.

void NATIVE_HESSIAN(uint element, uint first_row, elvis_vec3 xi, out NATIVE_TYPE f, out NATIVE_TYPE f1, out NATIVE_TYPE f2,
                    out NATIVE_TYPE f3, out NATIVE_TYPE f11, out NATIVE_TYPE f22, out NATIVE_TYPE f33, out NATIVE_TYPE f23,
                    out NATIVE_TYPE f13, out NATIVE_TYPE f12) {
    const NATIVE_TYPE zero = NATIVE_TYPE(0);
    f = f1 = f2 = f3 = f11 = f22 = f33 = f23 = f13 = f12 = zero;
    elvis_real t = (elvis_real(1) - xi.z) * elvis_real(0.5LF);
    elvis_real eta1 = native_pyramid_eta(xi.x + elvis_real(1) - t, t, NATIVE_ETA_LIMIT);
    elvis_real eta2 = native_pyramid_eta(xi.y + elvis_real(1) - t, t, NATIVE_ETA_LIMIT);
    elvis_real a[NATIVE_P + 1], a1[NATIVE_P + 1], a11[NATIVE_P + 1], b[NATIVE_Q + 1], b2[NATIVE_Q + 1], b22[NATIVE_Q + 1];
    elvis_real c[NATIVE_LARGEST_EXPONENT][NATIVE_R + 1], c3[NATIVE_LARGEST_EXPONENT][NATIVE_R + 1];
    elvis_real cp[NATIVE_LARGEST_EXPONENT][NATIVE_R + 1], cq[NATIVE_LARGEST_EXPONENT][NATIVE_R + 1];
    elvis_real cs[NATIVE_LARGEST_EXPONENT][NATIVE_R + 1];
    NATIVE_PYRAMID_CURVES(NATIVE_P, eta1, a, a1, a11)
    NATIVE_PYRAMID_CURVES(NATIVE_Q, eta2, b, b2, b22)
    elvis_real per_t = elvis_real(1) / (abs(t) < elvis_real(1.0e-15LF) ? elvis_real(1.0e-15LF) : t);
    NATIVE_PYRAMID_POWERS(xi.z, t, per_t, c, c3, cp, cq, cs)
    elvis_real m1 = (elvis_real(1) + eta1) * elvis_real(0.5LF), m2 = (elvis_real(1) + eta2) * elvis_real(0.5LF);
    // Sums over p and q of Q with one derivative of B, and of S with none.
    NATIVE_TYPE q1 = zero, q2 = zero, s = zero;
    int mode = 0;
    uint row = first_row;
    for (int p = 0; p <= NATIVE_P; ++p) {
        if (NATIVE_BASIS == 0) {
            mode = 0;
            row = first_row + uint(p * NATIVE_SLAB_ROWS);
        }
        NATIVE_TYPE f_p = zero, g_p = zero, g2_p = zero, f3_p = zero, p_p = zero, p2_p = zero, p22_p = zero, q_p = zero;
        NATIVE_TYPE q2_p = zero, s_p = zero;
        for (int q = 0; q <= NATIVE_Q; ++q) {
            NATIVE_TYPE apex = zero, g_pq = zero, f3_pq = zero, p_pq = zero, q_pq = zero, s_pq = zero;
            if (NATIVE_HAS_APEX(p, q)) {
                apex = NATIVE_COEFFICIENT(row, mode);
                ++mode;
            }
            for (int r = 0; r <= NATIVE_R; ++r)
                if (r < NATIVE_COUNT(p, q)) {
                    NATIVE_TYPE k = NATIVE_COEFFICIENT(row, mode);
                    g_pq += k * c[NATIVE_EXPONENT(p, q) - 1][r];
                    f3_pq += k * c3[NATIVE_EXPONENT(p, q) - 1][r];
                    p_pq += k * cp[NATIVE_EXPONENT(p, q) - 1][r];
                    q_pq += k * cq[NATIVE_EXPONENT(p, q) - 1][r];
                    s_pq += k * cs[NATIVE_EXPONENT(p, q) - 1][r];
                    ++mode;
                }
            NATIVE_TYPE f_pq = apex + g_pq * t;
            // e = 0
            g_pq += apex * per_t;
            p_pq += apex * per_t * per_t;
            q_pq += apex * elvis_real(0.5LF) * per_t * per_t;
            f_p += f_pq * b[q];
            g_p += g_pq * b[q];
            g2_p += g_pq * b2[q];
            f3_p += f3_pq * b[q];
            p_p += p_pq * b[q];
            p2_p += p_pq * b2[q];
            p22_p += p_pq * b22[q];
            q_p += q_pq * b[q];
            q2_p += q_pq * b2[q];
            s_p += s_pq * b[q];
        }
        f += f_p * a[p];
        f1 += g_p * a1[p];
        f2 += g2_p * a[p];
        f3 += (f3_p + g2_p * m2) * a[p] + g_p * a1[p] * m1;
        f11 += p_p * a11[p];
        f12 += p2_p * a1[p];
        f22 += p22_p * a[p];
        q1 += q_p * a1[p];
        q2 += q2_p * a[p];
        s += s_p * a[p];
    }
    f13 = q1 + m1 * f11 + m2 * f12;
    f23 = q2 + m1 * f12 + m2 * f22;
    f33 = s + elvis_real(2) * (m1 * q1 + m2 * q2) + m1 * m1 * f11 + elvis_real(2) * m1 * m2 * f12 + m2 * m2 * f22;
}
#endif
