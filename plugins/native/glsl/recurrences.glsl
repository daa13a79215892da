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
