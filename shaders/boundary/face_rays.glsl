// One step of Newton's method from a ray to a face, what it tells, and the nearest crossing.
//
// The kernel brings picture/pixel_ray.glsl, element/face_frame.glsl, element/inside.glsl, boundary/face_patch.glsl,
// boundary/face_point.glsl, and the buffer core_faces: local element, local face, number, misfit of the polynomial.

// In place of the index of a patch, or of a face among all.
#define CORE_NO_PATCH 0xffffffffu

struct core_face_newton_step {
    // Of the row of core_faces.
    uint element, number;
    int local_face;
    // The face where the step begins, and its error there; from elvis_origin of the element to the reference point.
    core_face_point point;
    elvis_real misfit;
    elvis_vec3 shift;

    bool is_regular;
    // Where the ray meets the tangent plane, and the step to there.
    elvis_real t, step_u, step_v;
    // Of (u, v), from rounding; and twice that of t.
    elvis_real error, width;
    // normal = x_u cross x_v; row_u, row_v give (u, v) from positions, seen along the ray.
    elvis_vec3 normal, row_u, row_v;
    elvis_real across;
};

core_face_newton_step core_face_newton(uint face, elvis_real u, elvis_real v, core_ray ray) {
    core_face_newton_step s;
    const uvec4 row = elvis_fetch4_core_faces(face, 0u);
    s.element = row.x;
    s.local_face = int(row.y);
    s.number = row.z;
    s.misfit = elvis_real(uintBitsToFloat(row.w));
    s.point = core_face_at(face, s.element, s.local_face, u, v);
    s.shift = core_reference.xyz - elvis_origin(s.element);
    const elvis_vec3 origin = s.shift + ray.origin;
    s.normal = cross(s.point.along_u, s.point.along_v);
    s.across = dot(s.normal, ray.direction);
    const elvis_real least = elvis_real(64) * CORE_ROUNDOFF;
    // The squares of both sides: less work than their lengths.
    s.is_regular = s.across * s.across > least * least * dot(s.normal, s.normal) * dot(ray.direction, ray.direction);
    const elvis_real inverse = s.is_regular ? elvis_real(1) / s.across : elvis_real(0);
    s.t = dot(s.normal, s.point.x - origin) * inverse;
    const elvis_vec3 left = origin + s.t * ray.direction - s.point.x;
    s.row_u = inverse * cross(s.point.along_v, ray.direction);
    s.row_v = inverse * cross(ray.direction, s.point.along_u);
    s.step_u = dot(s.row_u, left);
    s.step_v = dot(s.row_v, left);
    // Rounding of positions, and what the inverse makes of it.
    const elvis_vec3 terms = abs(s.shift) + abs(s.point.along_u) + abs(s.point.along_v) + abs(s.point.x) + abs(s.t * ray.direction);
    const elvis_vec3 noise = elvis_vec3(ray.error + s.misfit) + elvis_real(4) * CORE_ROUNDOFF * terms;
    s.error = max(dot(abs(s.row_u), noise), dot(abs(s.row_v), noise)) + elvis_real(4) * CORE_ROUNDOFF;
    s.width = elvis_real(4) * abs(inverse) * dot(abs(s.normal), noise);
    return s;
}

struct core_face_verdict {
    // The step ends at the crossing; the crossing is surely outside of the square; it is in it, and counts for the ray.
    bool has_converged, has_missed, is_hit;
    // Whether it counts is not known.
    bool is_doubtful;
};

// What is known after a step to (u, v), which is `outside` of the square, and at most `left` from the crossing but for rounding.
core_face_verdict core_judge_face_step(core_ray ray, core_face_newton_step s, elvis_real u, elvis_real v, elvis_real outside,
                                       elvis_real left) {
    core_face_verdict verdict;
    const elvis_real step_length = max(abs(s.step_u), abs(s.step_v));
    verdict.has_converged = s.is_regular && (step_length <= s.error || left <= elvis_real(0.5LF) * s.error);
    // Beyond the diagonal of a triangle u + v is off by both errors.
    verdict.has_missed = s.is_regular && outside > elvis_real(2) * (left + elvis_real(2) * s.error);
    bool is_there = verdict.has_converged && outside <= elvis_real(2) * s.error;
#if ELVIS_HAS_INSIDE
    is_there = is_there && core_is_within(s.element, core_face_xi(s.local_face, u, v), elvis_vec3(s.error));
#endif
    // The width is four times the bound of rounding.
    const elvis_real bound = elvis_real(0.25LF) * s.width;
    verdict.is_hit = is_there && s.t > ray.counts_from + elvis_real(0.5LF) * ray.widths_behind * s.width;
    // Behind a crossing, what is within the bound is that crossing again.
    const bool is_another = ray.widths_behind > elvis_real(0) && !verdict.is_hit && s.t > ray.counts_from + bound;
    verdict.is_doubtful = is_there && (is_another || core_is_at_start(ray, s.t, bound));
    return verdict;
}

// A crossing of the ray with a face.
struct core_face_crossing {
    // CORE_NO_PATCH: there is none.
    uint face, number, patch_index;
    // 1 if the ray enters the element here and the one that it leaves is drawn, too: that one, on the viewer's side, goes first.
    uint key;
    elvis_real u, v, t, slack;
    // Where the next pixel of the column meets the face, to first order.
    elvis_real next_u, next_v;
    bool is_on_edge;
    // The ray leaves the element; and the element behind the face is not drawn.
    bool leaves, is_outer;
    // Of the face, of any length.
    elvis_real normal_x, normal_y, normal_z;
    // At an edge, the ray meets two outer faces within rounding that are not one smooth surface: it may enter by the one, leave by the other,
    // or pass both.
    bool is_folded;
    // Faces that have the crossing.
    uint n_candidates;
};

core_face_crossing core_no_crossing() {
    const elvis_real zero = elvis_real(0), far = elvis_real(3.0e38LF);
    return core_face_crossing(CORE_NO_PATCH, CORE_NO_NUMBER, CORE_NO_PATCH, 0u, zero, zero, far, zero, zero, zero, false, false, false, zero,
                              zero, zero, false, 0u);
}

// Behind this nothing need be looked at.
float core_nearest_end(core_face_crossing nearest) { return float(nearest.t + nearest.slack); }

// After the step s to (u, v). `motion`: of the ray's point from this pixel to the next one of the column.
core_face_crossing core_face_crossing_at(uint face, uint patch_index, uint square_word, elvis_real u, elvis_real v,
                                         core_face_newton_step s, elvis_vec3 motion) {
    const bool leaves = (s.across > elvis_real(0)) == ((square_word & CORE_FACE_IS_OUTWARD) != 0u);
    const bool is_outer = (square_word & CORE_FACE_HAS_PARTNER) == 0u;
    const uint key = !is_outer && !leaves ? 1u : 0u;
    const elvis_real excess = (square_word & CORE_FACE_IS_TRIANGLE) != 0u ? max(max(-u, -v) - elvis_real(1), u + v)
                                                                          : max(abs(u), abs(v)) - elvis_real(1);
    return core_face_crossing(face, s.number, patch_index, key, u, v, s.t, s.width, u + dot(s.row_u, motion), v + dot(s.row_v, motion),
                              excess >= elvis_real(-2) * s.error, leaves, is_outer, s.normal.x, s.normal.y, s.normal.z, false, 1u);
}

// The faces are one surface there, but for what nobody sees.
bool core_has_same_face_normal(const core_face_crossing one, const core_face_crossing other) {
    const elvis_vec3 a = elvis_vec3(one.normal_x, one.normal_y, one.normal_z);
    const elvis_vec3 b = elvis_vec3(other.normal_x, other.normal_y, other.normal_z);
    const elvis_vec3 sine = cross(a, b);
    return dot(sine, sine) <= elvis_real(1e-6LF) * dot(a, a) * dot(b, b);
}

// Takes a crossing (`is_hit`) if it is before the nearest, or the same within rounding and goes before it: of two faces that coincide,
// that of the element on the viewer's side; on an edge, the face that the ray meets less obliquely, because its error is smaller; of
// equals, the lower number.
void core_take_crossing(bool is_hit, core_face_crossing found, inout core_face_crossing nearest) {
    const bool is_same = abs(found.t - nearest.t) <= max(found.slack, nearest.slack);
    const bool is_number_lower = found.number < nearest.number || (found.number == nearest.number && found.face < nearest.face);
    const bool is_lower = found.key != nearest.key ? found.key < nearest.key
                                                   : found.slack < elvis_real(0.5LF) * nearest.slack ||
                                                         (is_number_lower && found.slack <= elvis_real(2) * nearest.slack);
    const bool is_before = !is_same && found.t < nearest.t, is_other = is_hit && is_same && found.face != nearest.face;
    const uint n_candidates = is_hit && is_before ? 1u : nearest.n_candidates + (is_other ? 1u : 0u);
    const bool is_fold =
        is_other && found.is_outer && nearest.is_outer && (found.leaves != nearest.leaves || !core_has_same_face_normal(found, nearest));
    const bool is_folded = is_fold || (nearest.is_folded && !(is_hit && is_before));
    if (is_hit && (is_same ? is_lower : is_before)) {
        nearest = found;
    }
    nearest.is_folded = is_folded;
    nearest.n_candidates = n_candidates;
}
