// One sum at one level; see volume.glsl. Tables hold a jet for each index of a one-dimensional factor.
// NEKTAR_GRADIENT and NEKTAR_HESSIAN hold statements of the levels that have first and second derivatives.
#if NEKTAR_LEVEL >= 1
#define NEKTAR_GRADIENT(statements) statements
#else
#define NEKTAR_GRADIENT(statements)
#endif
#if NEKTAR_LEVEL >= 2
#define NEKTAR_HESSIAN(statements) statements
#else
#define NEKTAR_HESSIAN(statements)
#endif
#if NEKTAR_LEVEL == 0
#define NEKTAR_JET elvis_real
#define NEKTAR_VALUE(jet) (jet)
#define NEKTAR_CONSTANT(value) elvis_real(value)
#define NEKTAR_LINEAR(value, own, later) (value)
#elif NEKTAR_LEVEL == 1
#define NEKTAR_JET nektar_jet1
#define NEKTAR_VALUE(jet) (jet).v
#define NEKTAR_CONSTANT(value) nektar_jet1(elvis_real(value), elvis_real(0), elvis_real(0))
#define NEKTAR_LINEAR(value, own, later) nektar_jet1(value, elvis_real(own), elvis_real(later))
#else
#define NEKTAR_JET nektar_jet2
#define NEKTAR_VALUE(jet) (jet).v
#define NEKTAR_CONSTANT(value)                                                                                                     \
    nektar_jet2(elvis_real(value), elvis_real(0), elvis_real(0), elvis_real(0), elvis_real(0), elvis_real(0))
#define NEKTAR_LINEAR(value, own, later)                                                                                           \
    nektar_jet2(value, elvis_real(own), elvis_real(later), elvis_real(0), elvis_real(0), elvis_real(0))
#endif

// table[i] = 1 for i < first, then start t^n P_n^{a,b}(x/t) with n = i - first.
#define NEKTAR_JACOBI(order, table, first, start, a, b, x, t)                                                                      \
    {                                                                                                                              \
        NEKTAR_JET now = start, before = NEKTAR_CONSTANT(0);                                                                       \
        for (int n = 0; n <= order; ++n) {                                                                                         \
            if (n < (first)) {                                                                                                     \
                table[n] = NEKTAR_CONSTANT(1);                                                                                     \
            } else {                                                                                                               \
                table[n] = now;                                                                                                    \
                NEKTAR_JET next = nektar_next(nektar_jacobi(a, b, n - (first)), x, t, now, before);                                \
                before = now;                                                                                                      \
                now = next;                                                                                                        \
            }                                                                                                                      \
        }                                                                                                                          \
    }

#if NEKTAR_BASIS == 1
// A_p of one variable; A_p(x/t) t^p, where x = right - left, t = left + right; t^q B_{m,q}(x/t) without its factor l^m; the same of
// the last direction, where the parameter a depends on the shape.
#define NEKTAR_DIRECTION(order, table, x, nodes, scales)                                                                           \
    NEKTAR_JACOBI(order, table, 0, NEKTAR_CONSTANT(1), 0, 0, x, elvis_real(1))
#define NEKTAR_COLLAPSED(order, table, left, right, t)                                                                             \
    NEKTAR_JACOBI(order, table, 0, NEKTAR_CONSTANT(1), 0, 0, right - left, t)
#define NEKTAR_MIDDLE(order, table, m, left, right, t)                                                                             \
    NEKTAR_JACOBI(order, table, 0, NEKTAR_CONSTANT(1), 2 * (m) + 1, 0, right - left, t)
#if ELVIS_SHAPE == ELVIS_SHAPE_PRISM || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
#define NEKTAR_LAST(order, table, m, x)                                                                                            \
    NEKTAR_JACOBI(order, table, 0, NEKTAR_CONSTANT(1), 2 * (m) + 1, 0, x, elvis_real(1))
#else
#define NEKTAR_LAST(order, table, m, x)                                                                                            \
    NEKTAR_JACOBI(order, table, 0, NEKTAR_CONSTANT(1), 2 * (m) + 2, 0, x, elvis_real(1))
#endif
#else
// Modified: the same, with the factors left and right of each bubble in its recurrence from the start. B_{0,q} = A_q, whose first
// two functions are left to the sum: l makes up the power of t that A_0 wants, and r stands in modes of its own.
#define NEKTAR_COLLAPSED(order, table, left, right, t)                                                                             \
    NEKTAR_JACOBI(order, table, 2, nektar_times(NEKTAR_LINEAR(left, -0.5LF, -0.5LF), NEKTAR_LINEAR(right, 0.5LF, 0)), 1, 1,        \
                  right - left, t)                                                                                                 \
    table[0] = NEKTAR_LINEAR(left, -0.5LF, -0.5LF);                                                                                \
    table[1] = NEKTAR_LINEAR(right, 0.5LF, 0);
#define NEKTAR_MIDDLE(order, table, m, left, right, t)                                                                             \
    NEKTAR_JACOBI(order, table, (m) == 0 ? 2 : 1, NEKTAR_LINEAR(right, 0.5LF, 0), (m) == 0 ? 1 : 2 * (m) - 1, 1, right - left, t)
#define NEKTAR_LAST(order, table, m, x)                                                                                            \
    NEKTAR_JACOBI(order, table, (m) == 0 ? 2 : 1, NEKTAR_LINEAR((elvis_real(1) + x) * elvis_real(0.5LF), 0.5LF, 0),                \
                  (m) == 0 ? 1 : 2 * (m) - 1, 1, x, elvis_real(1))
#if NEKTAR_BASIS == 0
#define NEKTAR_DIRECTION(order, table, x, nodes, scales)                                                                           \
    {                                                                                                                              \
        elvis_real left = (elvis_real(1) - (x)) * elvis_real(0.5LF), right = (elvis_real(1) + (x)) * elvis_real(0.5LF);            \
        NEKTAR_JACOBI(order, table, 2, nektar_times(NEKTAR_LINEAR(left, -0.5LF, 0), NEKTAR_LINEAR(right, 0.5LF, 0)), 1, 1, x,      \
                      elvis_real(1))                                                                                               \
        table[0] = NEKTAR_LINEAR(left, -0.5LF, 0);                                                                                 \
        table[1] = NEKTAR_LINEAR(right, 0.5LF, 0);                                                                                 \
    }
#else
// Lagrange: scale_i prod_{j != i} (x - node_j), as the product of those before i and those behind.
#define NEKTAR_DIRECTION(order, table, x, nodes, scales)                                                                           \
    {                                                                                                                              \
        NEKTAR_JET product = NEKTAR_CONSTANT(1);                                                                                   \
        for (int i = 0; i <= order; ++i) {                                                                                         \
            table[i] = nektar_times(product, NEKTAR_CONSTANT(scales[i]));                                                          \
            product = nektar_times(product, NEKTAR_LINEAR(x - nodes[i], 1, 0));                                                    \
        }                                                                                                                          \
        product = NEKTAR_CONSTANT(1);                                                                                              \
        for (int i = 0; i <= order; ++i) {                                                                                         \
            table[order - i] = nektar_times(table[order - i], product);                                                            \
            product = nektar_times(product, NEKTAR_LINEAR(x - nodes[order - i], 1, 0));                                            \
        }                                                                                                                          \
    }
#endif
#endif

// The function's head, its first and its last statement.
#if NEKTAR_LEVEL == 0
#define NEKTAR_FUNCTION NEKTAR_TYPE NEKTAR_SUM(uint element, elvis_vec3 xi)
#define NEKTAR_BEGIN NEKTAR_TYPE f = NEKTAR_TYPE(0);
#define NEKTAR_END return f;
#elif NEKTAR_LEVEL == 1
#define NEKTAR_FUNCTION                                                                                                            \
    void NEKTAR_SUM(uint element, elvis_vec3 xi, out NEKTAR_TYPE f, out NEKTAR_TYPE f1, out NEKTAR_TYPE f2, out NEKTAR_TYPE f3)
#define NEKTAR_BEGIN f = f1 = f2 = f3 = NEKTAR_TYPE(0);
#define NEKTAR_END
#else
#define NEKTAR_FUNCTION                                                                                                            \
    void NEKTAR_SUM(uint element, elvis_vec3 xi, out NEKTAR_TYPE f, out NEKTAR_TYPE f1, out NEKTAR_TYPE f2, out NEKTAR_TYPE f3,    \
                    out NEKTAR_TYPE f11, out NEKTAR_TYPE f22, out NEKTAR_TYPE f33, out NEKTAR_TYPE f23, out NEKTAR_TYPE f13,       \
                    out NEKTAR_TYPE f12)
#define NEKTAR_BEGIN f = f1 = f2 = f3 = f11 = f22 = f33 = f23 = f13 = f12 = NEKTAR_TYPE(0);
#define NEKTAR_END
#endif

#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON || ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
#include "hexahedron.glsl"
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
#include "prism.glsl"
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
#include "pyramid.glsl"
#else
#include "tetrahedron.glsl"
#endif

#undef NEKTAR_GRADIENT
#undef NEKTAR_HESSIAN
#undef NEKTAR_FUNCTION
#undef NEKTAR_BEGIN
#undef NEKTAR_END
#undef NEKTAR_JET
#undef NEKTAR_VALUE
#undef NEKTAR_CONSTANT
#undef NEKTAR_LINEAR
#undef NEKTAR_JACOBI
#undef NEKTAR_DIRECTION
#undef NEKTAR_COLLAPSED
#undef NEKTAR_MIDDLE
#undef NEKTAR_LAST
