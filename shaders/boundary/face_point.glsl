// Points of element faces: x(u, v) relative to elvis_origin of the element, with both derivatives.
//
// CORE_FACE_ORDER: the faces' polynomials of that order in u and in v, as coefficients of products of Chebyshev polynomials,
// which the host found from samples of the mapping (core/volume/boundary/face_fit.hpp); a fraction of the work that the element's mapping
// is. Without it: the mapping itself.

struct core_face_point {
    elvis_vec3 x, along_u, along_v;
};

#ifdef CORE_FACE_ORDER
#define CORE_FACE_TERMS (CORE_FACE_ORDER + 1)
#define CORE_FACE_NUMBER(i) elvis_fetch4_core_face_points(face, uint((i) >> 2))[(i) & 3]
#define CORE_FACE_COEFFICIENT(i) elvis_vec3(CORE_FACE_NUMBER(3 * (i)), CORE_FACE_NUMBER(3 * (i) + 1), CORE_FACE_NUMBER(3 * (i) + 2))
// values[n] = T_n(x) and T_n'(x): literal bounds, so that compilers unroll.
#define CORE_CHEBYSHEV_SLOPES(x, values, slopes)                                                                                   \
    {                                                                                                                              \
        elvis_real now = elvis_real(1), before = elvis_real(0), slope = elvis_real(0), slope_before = elvis_real(0);               \
        for (int n = 0; n < CORE_FACE_TERMS; ++n) {                                                                                \
            values[n] = now;                                                                                                       \
            slopes[n] = slope;                                                                                                     \
            const elvis_real factor = elvis_real(n == 0 ? 1 : 2);                                                                  \
            const elvis_real next = factor * x * now - before;                                                                     \
            const elvis_real slope_next = factor * (now + x * slope) - slope_before;                                               \
            before = now;                                                                                                          \
            now = next;                                                                                                            \
            slope_before = slope;                                                                                                  \
            slope = slope_next;                                                                                                    \
        }                                                                                                                          \
    }

core_face_point core_face_at(uint face, uint element, int local_face, elvis_real u, elvis_real v) {
    elvis_real tu[CORE_FACE_TERMS], tv[CORE_FACE_TERMS], du[CORE_FACE_TERMS], dv[CORE_FACE_TERMS];
    CORE_CHEBYSHEV_SLOPES(u, tu, du)
    CORE_CHEBYSHEV_SLOPES(v, tv, dv)
    core_face_point point = core_face_point(elvis_vec3(0), elvis_vec3(0), elvis_vec3(0));
    for (int j = 0; j < CORE_FACE_TERMS; ++j) {
        elvis_vec3 sum = elvis_vec3(0), slope = elvis_vec3(0);
        for (int i = 0; i < CORE_FACE_TERMS; ++i) {
            const elvis_vec3 c = CORE_FACE_COEFFICIENT(j * CORE_FACE_TERMS + i);
            sum += tu[i] * c;
            slope += du[i] * c;
        }
        point.x += tv[j] * sum;
        point.along_u += tv[j] * slope;
        point.along_v += dv[j] * sum;
    }
    return point;
}
#else
core_face_point core_face_at(uint face, uint element, int local_face, elvis_real u, elvis_real v) {
    const core_face frame = core_face_frame(local_face);
    const elvis_vec3 half_a = elvis_real(0.5LF) * frame.a, half_b = elvis_real(0.5LF) * frame.b;
    elvis_mat3 jacobian;
    core_face_point point;
    elvis_mapping_jacobian(element, frame.corner + (u + elvis_real(1)) * half_a + (v + elvis_real(1)) * half_b, point.x, jacobian);
    point.along_u = jacobian * half_a;
    point.along_v = jacobian * half_b;
    return point;
}
#endif

// Reference coordinates in the element.
elvis_vec3 core_face_xi(int local_face, elvis_real u, elvis_real v) {
    const core_face frame = core_face_frame(local_face);
    const elvis_real half_one = elvis_real(0.5LF);
    return frame.corner + ((u + elvis_real(1)) * half_one) * frame.a + ((v + elvis_real(1)) * half_one) * frame.b;
}
