// Faces of the reference shapes as parallelograms or triangles corner + s a + r b, s and r from 0 to 1 (s + r <= 1).

#ifndef CORE_FACE_FRAME
#define CORE_FACE_FRAME

// The element is a face itself.
#define CORE_HAS_TWO_DIMENSIONS (ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL || ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE)

struct core_face {
    elvis_vec3 corner, a, b;
    // 1 if a x b points out of the reference shape, else -1.
    elvis_real orientation;
    bool is_triangle;
};

// The sides are those from the first corner of the face (elvis/element.h) to its second and its last.
core_face core_face_frame(int face) {
    const elvis_vec3 x = elvis_vec3(2, 0, 0), y = elvis_vec3(0, 2, 0), z = elvis_vec3(0, 0, 2);
    const elvis_vec3 c0 = elvis_vec3(-1, -1, -1), c1 = c0 + x, c3 = c0 + y;
    core_face f = core_face(c0, x, y, elvis_real(-1), false);
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
    if (face == 1) f = core_face(c0, x, z, elvis_real(1), false);
    if (face == 2) f = core_face(c1, y, z, elvis_real(1), false);
    if (face == 3) f = core_face(c3, x, z, elvis_real(-1), false);
    if (face == 4) f = core_face(c0, y, z, elvis_real(-1), false);
    if (face == 5) f = core_face(c0 + z, x, y, elvis_real(1), false);
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM
    if (face == 1) f = core_face(c0, x, z, elvis_real(1), true);
    if (face == 2) f = core_face(c1, y, z - x, elvis_real(1), false);
    if (face == 3) f = core_face(c3, x, z, elvis_real(-1), true);
    if (face == 4) f = core_face(c0, y, z, elvis_real(-1), false);
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
    if (face == 1) f = core_face(c0, x, z, elvis_real(1), true);
    if (face == 2) f = core_face(c1, y, z - x, elvis_real(1), true);
    if (face == 3) f = core_face(c3, x, z - y, elvis_real(-1), true);
    if (face == 4) f = core_face(c0, y, z, elvis_real(-1), true);
#elif CORE_HAS_TWO_DIMENSIONS
    // The element itself.
    f.corner.z = elvis_real(0);
    f.is_triangle = ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE;
#else
    f.is_triangle = true;
    if (face == 1) f = core_face(c0, x, z, elvis_real(1), true);
    if (face == 2) f = core_face(c1, y - x, z - x, elvis_real(1), true);
    if (face == 3) f = core_face(c0, y, z, elvis_real(-1), true);
#endif
    return f;
}

// In the frame of a face: how positions change with s and r, and the outward normal, about as long. `jacobian`: of the mapping.
elvis_mat3 core_face_tangents(core_face face, elvis_mat3 jacobian) {
    const elvis_vec3 s = jacobian * face.a, r = jacobian * face.b, normal = cross(s, r);
    // Elements may be turned inside out.
    const elvis_real side = face.orientation * sign(dot(jacobian[0], cross(jacobian[1], jacobian[2])));
    return elvis_mat3(s, r, side / sqrt(length(normal)) * normal);
}

// The Jacobian of the mapping, completed for elements of two dimensions by a normal of about the length of the other columns.
elvis_mat3 core_full_jacobian(elvis_mat3 jacobian) {
#if CORE_HAS_TWO_DIMENSIONS
    const elvis_vec3 normal = cross(jacobian[0], jacobian[1]);
    jacobian[2] = normal / sqrt(length(normal));
#endif
    return jacobian;
}

#endif
