// Faces of the reference shapes as linear constraints g(xi) = dot(normal, xi) + offset <= 0, in the order of the local faces in
// elvis/element.h. Depends on ELVIS_SHAPE; included once for each snippet instance.

#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
#define CORE_N_FACES 6
#elif ELVIS_SHAPE == ELVIS_SHAPE_TETRAHEDRON || ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
#define CORE_N_FACES 4
#elif ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
#define CORE_N_FACES 3
#else
#define CORE_N_FACES 5
#endif

// Normal (not of unit length: entries are -1, 0, 1) and offset of a face.
elvis_vec4 core_face_constraint(int face) {
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
    return face == 0   ? elvis_vec4(0, 0, -1, -1)
           : face == 1 ? elvis_vec4(0, -1, 0, -1)
           : face == 2 ? elvis_vec4(1, 0, 0, -1)
           : face == 3 ? elvis_vec4(0, 1, 0, -1)
           : face == 4 ? elvis_vec4(-1, 0, 0, -1)
                       : elvis_vec4(0, 0, 1, -1);
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM
    return face == 0   ? elvis_vec4(0, 0, -1, -1)
           : face == 1 ? elvis_vec4(0, -1, 0, -1)
           : face == 2 ? elvis_vec4(1, 0, 1, 0)
           : face == 3 ? elvis_vec4(0, 1, 0, -1)
                       : elvis_vec4(-1, 0, 0, -1);
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
    return face == 0   ? elvis_vec4(0, 0, -1, -1)
           : face == 1 ? elvis_vec4(0, -1, 0, -1)
           : face == 2 ? elvis_vec4(1, 0, 1, 0)
           : face == 3 ? elvis_vec4(0, 1, 1, 0)
                       : elvis_vec4(-1, 0, 0, -1);
#elif ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
    return face == 0   ? elvis_vec4(0, -1, 0, -1)
           : face == 1 ? elvis_vec4(1, 0, 0, -1)
           : face == 2 ? elvis_vec4(0, 1, 0, -1)
                       : elvis_vec4(-1, 0, 0, -1);
#elif ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    return face == 0 ? elvis_vec4(0, -1, 0, -1) : face == 1 ? elvis_vec4(1, 1, 0, 0) : elvis_vec4(-1, 0, 0, -1);
#else
    return face == 0   ? elvis_vec4(0, 0, -1, -1)
           : face == 1 ? elvis_vec4(0, -1, 0, -1)
           : face == 2 ? elvis_vec4(1, 1, 1, 1)
                       : elvis_vec4(-1, 0, 0, -1);
#endif
}

// Largest s >= 0 for which xi + s * direction still satisfies every constraint; 0 if xi lies on or outside a face and moves out,
// `limit` if nothing is met before.
elvis_real core_room(elvis_vec3 xi, elvis_vec3 direction, elvis_real limit) {
    elvis_real room = limit;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        elvis_vec4 constraint = core_face_constraint(face);
        elvis_real slope = dot(constraint.xyz, direction);
        elvis_real distance = -(dot(constraint.xyz, xi) + constraint.w);
        room = slope > elvis_real(0) ? min(room, max(distance, elvis_real(0)) / slope) : room;
    }
    return room;
}
