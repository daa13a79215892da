// Rays of pixels against faces: one step of Newton's method, and what is known of the nearest crossing.
//
// The kernel brings picture/pixel_ray.glsl, element/face_frame.glsl, boundary/face_patch.glsl, boundary/face_point.glsl, and the buffer
// core_faces: local element, local face, number, misfit of the polynomial.

#define CORE_NO_FACE 0xffffffffu

struct core_face_step {
    bool is_regular;
    elvis_real t, step_u, step_v;
    // Of (u, v), from rounding; and twice that of t.
    elvis_real error, width;
    // normal = x_u cross x_v; row_u, row_v give (u, v) from positions, seen along the ray.
    elvis_vec3 normal, row_u, row_v;
    elvis_real across;
};

// t from the tangent plane, and the step in it.
core_face_step core_face_newton(core_face_point point, elvis_vec3 shift, core_ray ray, elvis_real misfit) {
    const elvis_vec3 origin = shift + ray.origin;
    core_face_step s;
    s.normal = cross(point.along_u, point.along_v);
    s.across = dot(s.normal, ray.direction);
    const elvis_real least = elvis_real(64) * CORE_ROUNDOFF;
    // The squares of both sides: less work than their lengths.
    s.is_regular = s.across * s.across > least * least * dot(s.normal, s.normal) * dot(ray.direction, ray.direction);
    const elvis_real inverse = s.is_regular ? elvis_real(1) / s.across : elvis_real(0);
    s.t = dot(s.normal, point.x - origin) * inverse;
    const elvis_vec3 left = origin + s.t * ray.direction - point.x;
    s.row_u = inverse * cross(point.along_v, ray.direction);
    s.row_v = inverse * cross(ray.direction, point.along_u);
    s.step_u = dot(s.row_u, left);
    s.step_v = dot(s.row_v, left);
    // Rounding of positions, and what the inverse makes of it.
    const elvis_vec3 terms = abs(shift) + abs(point.along_u) + abs(point.along_v) + abs(point.x) + abs(s.t * ray.direction);
    const elvis_vec3 noise = elvis_vec3(ray.error + misfit) + elvis_real(4) * CORE_ROUNDOFF * terms;
    s.error = max(dot(abs(s.row_u), noise), dot(abs(s.row_v), noise)) + elvis_real(4) * CORE_ROUNDOFF;
    s.width = elvis_real(4) * abs(inverse) * dot(abs(s.normal), noise);
    return s;
}

// The nearest crossing so far.
struct core_nearest_face {
    uint face, number, patch_index, key;
    elvis_real u, v, t, slack;
    // Where the next pixel of the column meets the face, to first order.
    elvis_real next_u, next_v;
    bool is_on_edge;
    uint n_candidates;
};

core_nearest_face core_nothing_yet() {
    core_nearest_face nearest;
    nearest.face = nearest.number = nearest.patch_index = CORE_NO_FACE;
    nearest.key = 0u;
    nearest.u = nearest.v = nearest.slack = nearest.next_u = nearest.next_v = elvis_real(0);
    nearest.t = elvis_real(3.0e38LF);
    nearest.is_on_edge = false;
    nearest.n_candidates = 0u;
    return nearest;
}

// Takes a crossing if it is before the nearest, or the same within rounding and goes before it: of two faces that coincide, that
// of the element on the viewer's side; on an edge, the face that the ray meets less obliquely, because its error is smaller; of
// equals, the lower number.
void core_take_crossing(inout core_nearest_face nearest, bool is_hit, uint face, uint number, uint patch_index, uint key, elvis_real u,
                        elvis_real v, bool is_on_edge, core_face_step s, elvis_vec3 motion) {
    const bool is_same = abs(s.t - nearest.t) <= max(s.width, nearest.slack);
    const bool is_number_lower = number < nearest.number || (number == nearest.number && face < nearest.face);
    const bool is_lower = key != nearest.key ? key < nearest.key
                                             : s.width < elvis_real(0.5LF) * nearest.slack ||
                                                   (is_number_lower && s.width <= elvis_real(2) * nearest.slack);
    const bool is_better = is_hit && (is_same ? is_lower : s.t < nearest.t);
    const bool is_other = is_hit && is_same && face != nearest.face;
    nearest.n_candidates = is_hit && !is_same && s.t < nearest.t ? 1u : nearest.n_candidates + (is_other ? 1u : 0u);
    nearest.face = is_better ? face : nearest.face;
    nearest.number = is_better ? number : nearest.number;
    nearest.patch_index = is_better ? patch_index : nearest.patch_index;
    nearest.key = is_better ? key : nearest.key;
    nearest.u = is_better ? u : nearest.u;
    nearest.v = is_better ? v : nearest.v;
    nearest.t = is_better ? s.t : nearest.t;
    nearest.slack = is_better ? s.width : nearest.slack;
    nearest.is_on_edge = is_better ? is_on_edge : nearest.is_on_edge;
    nearest.next_u = is_better ? u + dot(s.row_u, motion) : nearest.next_u;
    nearest.next_v = is_better ? v + dot(s.row_v, motion) : nearest.next_v;
}

elvis_real core_face_excess(elvis_real u, elvis_real v, uint square_word) {
    return (square_word & CORE_FACE_IS_TRIANGLE) != 0u ? max(max(-u, -v) - elvis_real(1), u + v)
                                                       : max(abs(u), abs(v)) - elvis_real(1);
}

// 1 if the ray enters the element here and the one that it leaves is drawn, too: that one, on the viewer's side, goes first.
uint core_partner_key(uint square_word, elvis_real across) {
    const bool leaves = (across > elvis_real(0)) == ((square_word & CORE_FACE_IS_OUTWARD) != 0u);
    return (square_word & CORE_FACE_HAS_PARTNER) != 0u && !leaves ? 1u : 0u;
}
