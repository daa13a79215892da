// From collapsed coordinates, [-1,1]^3, into the reference shape.
elvis_vec3 core_expand(elvis_vec3 eta) {
    const elvis_real one = elvis_real(1);
    const elvis_real half_one = elvis_real(0.5LF);
    elvis_real x = eta.x, y = eta.y;
    elvis_real z = eta.z;
#if ELVIS_SHAPE == ELVIS_SHAPE_PRISM
    x = half_one * (one + x) * (one - z) - one;
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
    x = half_one * (one + x) * (one - z) - one;
    y = half_one * (one + y) * (one - z) - one;
#elif ELVIS_SHAPE == ELVIS_SHAPE_TETRAHEDRON
    y = half_one * (one + y) * (one - z) - one;
    x = half_one * (one + x) * (-y - z) - one;
#elif ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    x = half_one * (one + x) * (one - y) - one;
    z = elvis_real(0);
#elif ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
    z = elvis_real(0);
#endif
    return elvis_vec3(x, y, z);
}
