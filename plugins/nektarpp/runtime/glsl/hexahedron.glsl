// The sum in hexahedra: A_p(xi1) A_q(xi2) A_r(xi3), p fastest, r slowest; a slab holds one r. In quadrilaterals R = 0.

NEKTAR_FUNCTION {
    NEKTAR_BEGIN
    NEKTAR_JET a[NEKTAR_P + 1], b[NEKTAR_Q + 1], c[NEKTAR_R + 1];
    NEKTAR_DIRECTION(NEKTAR_P, a, xi.x, nektar_nodes_p, nektar_scales_p)
    NEKTAR_DIRECTION(NEKTAR_Q, b, xi.y, nektar_nodes_q, nektar_scales_q)
#if ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
    c[0] = NEKTAR_CONSTANT(1);
#else
    NEKTAR_DIRECTION(NEKTAR_R, c, xi.z, nektar_nodes_r, nektar_scales_r)
#endif
    for (int r = 0; r <= NEKTAR_R; ++r) {
        uint row = uint(r * NEKTAR_SLAB_ROWS);
        // Sums over p and q, and their derivatives.
        NEKTAR_TYPE g = NEKTAR_TYPE(0), g1 = g, g2 = g, g11 = g, g12 = g, g22 = g;
        for (int q = 0; q <= NEKTAR_Q; ++q) {
            NEKTAR_TYPE h = NEKTAR_TYPE(0), h1 = h, h11 = h;
            for (int p = 0; p <= NEKTAR_P; ++p) {
                NEKTAR_TYPE k = NEKTAR_COEFFICIENT(row, q * (NEKTAR_P + 1) + p);
                h += k * NEKTAR_VALUE(a[p]);
                NEKTAR_GRADIENT(h1 += k * a[p].o;)
                NEKTAR_HESSIAN(h11 += k * a[p].oo;)
            }
            g += h * NEKTAR_VALUE(b[q]);
            NEKTAR_GRADIENT(g1 += h1 * b[q].v; g2 += h * b[q].o;)
            NEKTAR_HESSIAN(g11 += h11 * b[q].v; g12 += h1 * b[q].o; g22 += h * b[q].oo;)
        }
        f += g * NEKTAR_VALUE(c[r]);
        NEKTAR_GRADIENT(f1 += g1 * c[r].v; f2 += g2 * c[r].v; f3 += g * c[r].o;)
        NEKTAR_HESSIAN(f11 += g11 * c[r].v; f12 += g12 * c[r].v; f22 += g22 * c[r].v; f13 += g1 * c[r].o; f23 += g2 * c[r].o;
                       f33 += g * c[r].oo;)
    }
    NEKTAR_END
}
