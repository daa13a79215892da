// Differences of sixth order along three directions that stay inside the element: see gradient_default.glsl. Included by what
// snippets lack, after element/reference_shape.glsl, once for each instance.

#ifndef CORE_STENCIL
#define CORE_STENCIL

#if ELVIS_REAL_IS_DOUBLE
#define CORE_GRADIENT_SPACING elvis_real(0.001LF)
#else
#define CORE_GRADIENT_SPACING elvis_real(0.02LF)
#endif

// Weight of point k of 7 for the derivative at point 3 (centred) or at point 0.
elvis_real core_gradient_weight(int k, bool is_centred) {
    const elvis_real sixtieth = elvis_real(1) / elvis_real(60);
    if (is_centred) {
        const int distance = abs(k - 3);
        const elvis_real size = elvis_real(distance == 1 ? 45 : distance == 2 ? -9 : distance == 3 ? 1 : 0);
        return (k < 3 ? -size : size) * sixtieth;
    }
    const int times_60 = k == 0 ? -147 : k == 1 ? 360 : k == 2 ? -450 : k == 3 ? 400 : k == 4 ? -225 : k == 5 ? 72 : -10;
    return elvis_real(times_60) * sixtieth;
}

// Three directions from xi to corners of the tetrahedron, the corner with the largest barycentric coordinate left out.
void core_stencil_directions(elvis_vec3 xi, out elvis_vec3 first, out elvis_vec3 second, out elvis_vec3 third) {
    // Barycentric coordinates of c1, c2, c3; that of c0 is what remains.
    const elvis_vec3 b = elvis_real(0.5LF) * (xi + elvis_vec3(1));
    const elvis_real b0 = elvis_real(1) - b.x - b.y - b.z;
    const elvis_vec3 to_0 = elvis_vec3(-1, -1, -1) - xi;
    first = elvis_vec3(1, -1, -1) - xi;
    second = elvis_vec3(-1, 1, -1) - xi;
    third = elvis_vec3(-1, -1, 1) - xi;
    const elvis_real largest = max(max(abs(b.x), abs(b.y)), max(abs(b.z), abs(b0)));
    if (abs(b.x) == largest) {
        first = to_0;
    } else if (abs(b.y) == largest) {
        second = to_0;
    } else if (abs(b.z) == largest) {
        third = to_0;
    }
}

// Point k of 7 along a direction is xi + (first + k) spacing direction, and its weight core_gradient_weight(k, is_centred) /
// spacing.
void core_stencil(elvis_vec3 xi, elvis_vec3 direction, out elvis_real spacing, out int first, out bool is_centred) {
    const elvis_real three = elvis_real(3);
    const elvis_real largest = CORE_GRADIENT_SPACING;
    const elvis_real room = core_room(xi, -direction, three * largest) / three;
    is_centred = elvis_real(8) * room >= largest;
    spacing = is_centred ? room : largest;
    first = is_centred ? -3 : 0;
}

#endif
