// How far predictions are off in an element that bends by its forms (core/volume/element/bend_form.hpp). A prediction from xi of a point
// xi + d of the element is the step p = J^-1 (x(xi + d) - x(xi)), and with the length N
//
//     p = d + J^-1 r,   r = x(xi + d) - x(xi) - J d,   |q . r| <= sqrt(q E q) N(d)^2 / 2   for all q,
//
//     N(d) <= N(p) + N(J^-1 r),   N(J^-1 r)^2 <= trace(G K) N(d)^4 / 4,   K = J^-1 E J^-T,
//
// so that N(d) is bounded as in element/prediction.glsl, with half the root of the trace for the curvature and N(p) for the length of the
// step. A function with the gradient q in the world is off by sqrt(q E q) N(d)^2 / 2.
//
// core_bend_forms: of each element the diagonals of G and E, and their entries 12, 13, 23; zero where nothing is known.

#ifndef CORE_BEND_FORM
#define CORE_BEND_FORM

#include "element/element_frame.glsl"
#include "element/prediction.glsl"

#if defined(elvis_fetch4_core_bend_forms)
#define CORE_HAS_BEND_FORMS 1

struct core_symmetric_matrix {
    elvis_vec3 diagonal, beside;
};

// u M u, of a matrix whose value is not negative.
elvis_real core_quadratic_form(const core_symmetric_matrix m, elvis_vec3 u) {
    const elvis_vec3 products = elvis_vec3(u.x * u.y, u.x * u.z, u.y * u.z);
    return max(dot(m.diagonal, u * u) + elvis_real(2) * dot(m.beside, products), elvis_real(0));
}

elvis_real core_bilinear_form(const core_symmetric_matrix m, elvis_vec3 u, elvis_vec3 v) {
    const elvis_vec3 products = elvis_vec3(u.x * v.y + u.y * v.x, u.x * v.z + u.z * v.x, u.y * v.z + u.z * v.y);
    return dot(m.diagonal, u * v) + dot(m.beside, products);
}

// At a point of an element.
struct core_local_bend {
    // G and E, and the diagonal of K.
    core_symmetric_matrix lengths, ways;
    elvis_vec3 off;
    // By the length N.
    elvis_real curvature;
    bool is_known;
};

core_local_bend core_local_bend_at(uint element, const core_frame frame) {
    const core_symmetric_matrix g =
        core_symmetric_matrix(elvis_fetch4_core_bend_forms(element, 0u).xyz, elvis_fetch4_core_bend_forms(element, 1u).xyz);
    const core_symmetric_matrix e =
        core_symmetric_matrix(elvis_fetch4_core_bend_forms(element, 2u).xyz, elvis_fetch4_core_bend_forms(element, 3u).xyz);
    const elvis_vec3 off = elvis_vec3(core_quadratic_form(e, frame.row0), core_quadratic_form(e, frame.row1),
                                      core_quadratic_form(e, frame.row2));
    const elvis_vec3 off_beside = elvis_vec3(core_bilinear_form(e, frame.row0, frame.row1), core_bilinear_form(e, frame.row0, frame.row2),
                                             core_bilinear_form(e, frame.row1, frame.row2));
    const elvis_real trace = dot(g.diagonal, off) + elvis_real(2) * dot(g.beside, off_beside);
    const elvis_real lost = elvis_real(32) * CORE_ROUNDOFF * (dot(g.diagonal, off) + elvis_real(2) * dot(abs(g.beside), abs(off_beside)));
    return core_local_bend(g, e, off, elvis_real(0.5LF) * sqrt(max(trace, elvis_real(0)) + lost), g.diagonal.x > elvis_real(0));
}

// N(u).
elvis_real core_bend_length(const core_local_bend bend, elvis_vec3 u) { return sqrt(core_quadratic_form(bend.lengths, u)); }

// The largest N(u) of a u of at most 1 in the maximum norm.
elvis_real core_bend_length_of_cube(const core_local_bend bend) {
    return max(max(core_bend_length(bend, elvis_vec3(1, 1, 1)), core_bend_length(bend, elvis_vec3(1, 1, -1))),
               max(core_bend_length(bend, elvis_vec3(1, -1, 1)), core_bend_length(bend, elvis_vec3(-1, 1, 1))));
}

// How far a prediction is off in the maximum norm, with N(d) = `distance` at most.
elvis_real core_bend_error(const core_local_bend bend, elvis_real distance) {
    return elvis_real(0.5LF) * distance * distance * sqrt(core_max_norm(bend.off));
}

// The same of a function with this gradient in the world.
elvis_real core_bend_value_error(const core_local_bend bend, elvis_vec3 gradient, elvis_real distance) {
    return elvis_real(0.5LF) * distance * distance * sqrt(core_quadratic_form(bend.ways, gradient));
}
#else
#define CORE_HAS_BEND_FORMS 0
#endif

#endif
