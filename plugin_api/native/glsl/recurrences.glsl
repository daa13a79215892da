// Three-term recurrences in scaled form: S_n(x, t) = t^n P_n(x/t) is a polynomial in x and t and satisfies
//
//     S_{n+1} = (A t + B x) S_n - C t^2 S_{n-1},        S_0 = 1, S_{-1} = 0.
//
// The functions below give (A, B, C) for literal n, so that the compiler computes them; t = 1 is the plain polynomial.
//
// Derivatives. In a collapsed direction d, x and t are linear in xi: along xi_d itself dx = 1, dt = 0 ("own"), along every
// direction that collapses d, dx = 1/2, dt = -1/2 ("later"). Hence
//
//     own_{n+1}   = B S_n           + (A t + B x) own_n   - C t^2 own_{n-1}
//     later_{n+1} = (B - A)/2 S_n   + (A t + B x) later_n - C t^2 later_{n-1} + C t S_{n-1}

// Legendre polynomials.
elvis_vec3 native_legendre(int n) {
    return elvis_vec3(0, elvis_real(2 * n + 1) / elvis_real(n + 1), elvis_real(n) / elvis_real(n + 1));
}

// Jacobi polynomials P^{a,0}, a >= 1 (Abramowitz & Stegun 22.7.1).
elvis_vec3 native_jacobi(int a, int n) {
    elvis_real s = elvis_real(2 * n + a);
    elvis_real divisor = elvis_real(2 * (n + 1) * (n + a + 1)) * s;
    return elvis_vec3(elvis_real(a * a) * (s + elvis_real(1)), s * (s + elvis_real(1)) * (s + elvis_real(2)),
                      elvis_real(2 * n * (n + a)) * (s + elvis_real(2))) /
           divisor;
}

// Jacobi polynomials P^{1,1}.
elvis_vec3 native_jacobi_11(int n) {
    elvis_real divisor = elvis_real((n + 1) * (n + 3));
    return elvis_vec3(0, elvis_real((n + 2) * (2 * n + 3)) / divisor, elvis_real((n + 1) * (n + 2)) / divisor);
}

// values[n] = T_n(x), Chebyshev polynomials, n = 0 .. order.
#define NATIVE_CHEBYSHEV(order, x, values)                                                                                         \
    {                                                                                                                              \
        elvis_real now = elvis_real(1), before = elvis_real(0);                                                                    \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            values[n] = now;                                                                                                       \
            elvis_real next = (n == 0 ? x : elvis_real(2) * x) * now - before;                                                     \
            before = now;                                                                                                          \
            now = next;                                                                                                            \
        }                                                                                                                          \
    }

// The same with derivatives.
#define NATIVE_CHEBYSHEV_SLOPES(order, x, values, slopes)                                                                          \
    {                                                                                                                              \
        elvis_real now = elvis_real(1), before = elvis_real(0), slope = elvis_real(0), slope_before = elvis_real(0);               \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            values[n] = now;                                                                                                       \
            slopes[n] = slope;                                                                                                     \
            elvis_real factor = elvis_real(n == 0 ? 1 : 2);                                                                        \
            elvis_real next = factor * x * now - before;                                                                           \
            elvis_real slope_next = factor * (now + x * slope) - slope_before;                                                     \
            before = now;                                                                                                          \
            now = next;                                                                                                            \
            slope_before = slope;                                                                                                  \
            slope = slope_next;                                                                                                    \
        }                                                                                                                          \
    }

// values[n] = t^n P_n(x/t), n = 0 .. order; `abc` is an expression in n, one of the functions above.
#define NATIVE_SCALED(order, abc, x, t, values)                                                                                    \
    {                                                                                                                              \
        elvis_real now = elvis_real(1), before = elvis_real(0);                                                                    \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            values[n] = now;                                                                                                       \
            elvis_vec3 k = abc;                                                                                                    \
            elvis_real next = (k[0] * t + k[1] * x) * now - k[2] * t * t * before;                                                 \
            before = now;                                                                                                          \
            now = next;                                                                                                            \
        }                                                                                                                          \
    }

// The same with the derivatives "own" and "later".
#define NATIVE_SCALED_SLOPES(order, abc, x, t, values, owns, laters)                                                               \
    {                                                                                                                              \
        elvis_real now = elvis_real(1), before = elvis_real(0), own = elvis_real(0), own_before = elvis_real(0);                   \
        elvis_real later = elvis_real(0), later_before = elvis_real(0);                                                            \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            values[n] = now;                                                                                                       \
            owns[n] = own;                                                                                                         \
            laters[n] = later;                                                                                                     \
            elvis_vec3 k = abc;                                                                                                    \
            elvis_real factor = k[0] * t + k[1] * x, tail = k[2] * t;                                                              \
            elvis_real next = factor * now - tail * t * before;                                                                    \
            elvis_real own_next = k[1] * now + factor * own - tail * t * own_before;                                               \
            elvis_real later_next =                                                                                                \
                (k[1] - k[0]) * elvis_real(0.5LF) * now + factor * later - tail * t * later_before + tail * before;                \
            before = now;                                                                                                          \
            now = next;                                                                                                            \
            own_before = own;                                                                                                      \
            own = own_next;                                                                                                        \
            later_before = later;                                                                                                  \
            later = later_next;                                                                                                    \
        }                                                                                                                          \
    }

// values[n] = P_n(x) and derivatives, n = 0 .. order.
#define NATIVE_PLAIN_SLOPES(order, abc, x, values, slopes)                                                                         \
    {                                                                                                                              \
        elvis_real now = elvis_real(1), before = elvis_real(0), slope = elvis_real(0), slope_before = elvis_real(0);               \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            values[n] = now;                                                                                                       \
            slopes[n] = slope;                                                                                                     \
            elvis_vec3 k = abc;                                                                                                    \
            elvis_real factor = k[0] + k[1] * x;                                                                                   \
            elvis_real next = factor * now - k[2] * before;                                                                        \
            elvis_real slope_next = k[1] * now + factor * slope - k[2] * slope_before;                                             \
            before = now;                                                                                                          \
            now = next;                                                                                                            \
            slope_before = slope;                                                                                                  \
            slope = slope_next;                                                                                                    \
        }                                                                                                                          \
    }

// Second derivatives. With the partial derivatives of S by x and t,
//
//     Sx_{n+1}  = B S_n          + (A t + B x) Sx_n  - C t^2 Sx_{n-1}
//     St_{n+1}  = A S_n          + (A t + B x) St_n  - C t^2 St_{n-1}  - 2 C t S_{n-1}
//     Sxx_{n+1} = 2 B Sx_n       + (A t + B x) Sxx_n - C t^2 Sxx_{n-1}
//     Sxt_{n+1} = A Sx_n + B St_n + (A t + B x) Sxt_n - C t^2 Sxt_{n-1} - 2 C t Sx_{n-1}
//     Stt_{n+1} = 2 A St_n       + (A t + B x) Stt_n - C t^2 Stt_{n-1} - 4 C t St_{n-1} - 2 C S_{n-1}
//
// own = Sx, later = (Sx - St)/2; own own = Sxx, own later = (Sxx - Sxt)/2, later later = (Sxx - 2 Sxt + Stt)/4.
#define NATIVE_SCALED_CURVES(order, abc, x, t, values, owns, laters, own_owns, own_laters, later_laters)                           \
    {                                                                                                                              \
        elvis_real s_ = elvis_real(1), s0_ = elvis_real(0), sx_ = elvis_real(0), sx0_ = elvis_real(0), st_ = elvis_real(0);        \
        elvis_real st0_ = elvis_real(0), sxx_ = elvis_real(0), sxx0_ = elvis_real(0), sxt_ = elvis_real(0), sxt0_ = elvis_real(0); \
        elvis_real stt_ = elvis_real(0), stt0_ = elvis_real(0);                                                                    \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            values[n] = s_;                                                                                                        \
            owns[n] = sx_;                                                                                                         \
            laters[n] = elvis_real(0.5LF) * (sx_ - st_);                                                                           \
            own_owns[n] = sxx_;                                                                                                    \
            own_laters[n] = elvis_real(0.5LF) * (sxx_ - sxt_);                                                                     \
            later_laters[n] = elvis_real(0.25LF) * (sxx_ - elvis_real(2) * sxt_ + stt_);                                           \
            elvis_vec3 k = abc;                                                                                                    \
            elvis_real l_ = k[0] * t + k[1] * x, c_ = k[2] * t * t, c1_ = elvis_real(2) * k[2] * t, c2_ = elvis_real(2) * k[2];    \
            elvis_real next_stt = elvis_real(2) * k[0] * st_ + l_ * stt_ - c_ * stt0_ - elvis_real(2) * c1_ * st0_ - c2_ * s0_;    \
            elvis_real next_sxt = k[0] * sx_ + k[1] * st_ + l_ * sxt_ - c_ * sxt0_ - c1_ * sx0_;                                   \
            elvis_real next_sxx = elvis_real(2) * k[1] * sx_ + l_ * sxx_ - c_ * sxx0_;                                             \
            elvis_real next_st = k[0] * s_ + l_ * st_ - c_ * st0_ - c1_ * s0_;                                                     \
            elvis_real next_sx = k[1] * s_ + l_ * sx_ - c_ * sx0_;                                                                 \
            elvis_real next_s = l_ * s_ - c_ * s0_;                                                                                \
            s0_ = s_;                                                                                                              \
            sx0_ = sx_;                                                                                                            \
            st0_ = st_;                                                                                                            \
            sxx0_ = sxx_;                                                                                                          \
            sxt0_ = sxt_;                                                                                                          \
            stt0_ = stt_;                                                                                                          \
            s_ = next_s;                                                                                                           \
            sx_ = next_sx;                                                                                                         \
            st_ = next_st;                                                                                                         \
            sxx_ = next_sxx;                                                                                                       \
            sxt_ = next_sxt;                                                                                                       \
            stt_ = next_stt;                                                                                                       \
        }                                                                                                                          \
    }

// P_n(x) with first and second derivatives.
#define NATIVE_PLAIN_CURVES(order, abc, x, values, slopes, curves)                                                                 \
    {                                                                                                                              \
        elvis_real s_ = elvis_real(1), s0_ = elvis_real(0), s1_ = elvis_real(0), s10_ = elvis_real(0), s2_ = elvis_real(0);        \
        elvis_real s20_ = elvis_real(0);                                                                                           \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            values[n] = s_;                                                                                                        \
            slopes[n] = s1_;                                                                                                       \
            curves[n] = s2_;                                                                                                       \
            elvis_vec3 k = abc;                                                                                                    \
            elvis_real l_ = k[0] + k[1] * x;                                                                                       \
            elvis_real next_s2 = elvis_real(2) * k[1] * s1_ + l_ * s2_ - k[2] * s20_;                                              \
            elvis_real next_s1 = k[1] * s_ + l_ * s1_ - k[2] * s10_;                                                               \
            elvis_real next_s = l_ * s_ - k[2] * s0_;                                                                              \
            s0_ = s_;                                                                                                              \
            s10_ = s1_;                                                                                                            \
            s20_ = s2_;                                                                                                            \
            s_ = next_s;                                                                                                           \
            s1_ = next_s1;                                                                                                         \
            s2_ = next_s2;                                                                                                         \
        }                                                                                                                          \
    }

// A, B, C of the Chebyshev polynomials.
elvis_vec3 native_chebyshev(int n) { return elvis_vec3(0, elvis_real(n == 0 ? 1 : 2), elvis_real(n == 0 ? 0 : 1)); }
