// Where a ray runs through an element with curved faces, from nothing but elvis_mapping_jacobian: the default for every snippet.
//
// A face is a parallelogram or triangle corner + s a + r b in reference coordinates (core_face_frame). The ray with origin o and
// unit direction d meets it where
//
//   F(s, r) = (e1, e2) . (x(corner + s a + r b) - o) = 0,     e1, e2, d orthonormal,
//
// at the parameter t = d . (x - o) / d . d. Newton's method looks for the roots of F from the centres of CORE_RAY_PATCHES^2 patches
// of each face. A patch is left after one evaluation if the linear model there puts the root more than one patch away: its
// neighbours start closer. So a ray that misses costs one evaluation a patch. This finds all roots while F is close to linear
// within a patch; that is an assumption (no bound of the mapping's curvature is known here), so segments are estimates in the sense
// of elvis/runtime.h.
//
// The ray enters where the face constraint g decreases along it. World normal cross(J a, J b) = cof(J) (a x b) points out of the
// element if (a x b).grad g and det J have the same sign. The line is followed in both directions; who starts inside clips at t =
// 0.
//
// Measured (tests/defaults) on elements of all four shapes with faces bent by up to 0.4 of half their size, up to 3 % of which are
// hit twice: no wrong segment without a flag, 0.1 % of the rays flagged; t within 5e-14 in float64 and 7e-5 in float32, worse only
// where the ray nearly touches a face.
//
// In single precision the origin should be close to the element: t is no more exact than the coordinates of the origin.

#ifndef CORE_RAY_INTERSECTION
#define CORE_RAY_INTERSECTION

#include "element/element_frame.glsl"
#include "element/face_frame.glsl"

#ifndef CORE_RAY_PATCHES
#define CORE_RAY_PATCHES 3
#endif
#define CORE_RAY_STARTS uint(CORE_N_FACES * CORE_RAY_PATCHES * CORE_RAY_PATCHES)
// Evaluations a ray: one a start, and four times as many for those that go on. Roots that are met from several starts are few.
#define CORE_RAY_WORK (5u * CORE_RAY_STARTS)
// From a start within two thirds of a patch, six steps converge in double precision; a double root (the ray touches the face)
// halves its distance with each.
#define CORE_RAY_STEPS 12u
#define CORE_RAY_MAX_CROSSINGS 8u

// A Newton iteration came close to the face's surface and did not end: the ray grazes the face.
#define CORE_RAY_FAILED 1u
// More crossings than there is room for.
#define CORE_RAY_OVERFLOW 2u
// Entries and exits do not alternate: one was missed, or the element is folded.
#define CORE_RAY_INCONSISTENT 4u
#define CORE_RAY_WORK_LIMIT 8u

struct core_ray_segments {
    uint count;
    // CORE_RAY_...; 0 if all is certain.
    uint flags;
    // Sorted: enter[i] < leave[i] <= enter[i + 1].
    elvis_real enter[CORE_RAY_MAX_CROSSINGS / 2u];
    elvis_real leave[CORE_RAY_MAX_CROSSINGS / 2u];
};

// How far (s, r) lies outside the face; <= 0 inside.
elvis_real core_face_excess(elvis_real s, elvis_real r, bool is_triangle) {
    const elvis_real one = elvis_real(1);
    return max(max(-s, -r), is_triangle ? s + r - one : max(s, r) - one);
}

// Crossings of the line in the order of t. All those within `slack` of each other and of one kind are one: a ray through an edge
// meets both faces, and several starts lead to one root.
struct core_face_crossings {
    uint count;
    uint flags;
    elvis_real slack;
    elvis_real t[CORE_RAY_MAX_CROSSINGS];
    bool enters[CORE_RAY_MAX_CROSSINGS];
    // On the face's edge within rounding.
    bool is_on_edge[CORE_RAY_MAX_CROSSINGS];
};

void core_add_face_crossing(inout core_face_crossings list, elvis_real t, bool enters, bool is_on_edge, elvis_real error) {
    list.slack = max(list.slack, error);
    bool is_known = false;
    uint position = 0u;
    for (uint i = 0u; i < CORE_RAY_MAX_CROSSINGS; ++i) {
        const bool is_there = i < list.count;
        const bool is_same = is_there && list.enters[i] == enters && abs(list.t[i] - t) <= list.slack;
        list.is_on_edge[i] = list.is_on_edge[i] && (is_on_edge || !is_same);
        is_known = is_known || is_same;
        position += is_there && list.t[i] < t ? 1u : 0u;
    }
    const bool is_full = list.count == CORE_RAY_MAX_CROSSINGS;
    list.flags |= !is_known && is_full ? CORE_RAY_OVERFLOW : 0u;
    if (!is_known && !is_full) {
        for (uint i = CORE_RAY_MAX_CROSSINGS - 1u; i > 0u; --i) {
            if (i > position) {
                list.t[i] = list.t[i - 1u];
                list.enters[i] = list.enters[i - 1u];
                list.is_on_edge[i] = list.is_on_edge[i - 1u];
            }
        }
        list.t[position] = t;
        list.enters[position] = enters;
        list.is_on_edge[position] = is_on_edge;
        list.count += 1u;
    }
}

core_ray_segments core_pair_crossings(core_face_crossings list) {
    core_ray_segments segments;
    segments.count = 0u;
    segments.flags = list.flags;
    bool is_inside = false;
    bool is_skipped = false;
    elvis_real entered = elvis_real(0);
    for (uint i = 0u; i < CORE_RAY_MAX_CROSSINGS; ++i) {
        const uint next = min(i + 1u, CORE_RAY_MAX_CROSSINGS - 1u);
        const bool is_there = i < list.count && !is_skipped;
        const bool enters = is_there && list.enters[i];
        const bool leaves = is_there && !list.enters[i];
        // Out of order: fine if it is undone within rounding, or if the ray touches an edge from outside and only one of the two
        // faces there is met, for the same reason.
        const bool is_wrong = (enters && is_inside) || (leaves && !is_inside);
        is_skipped = is_wrong && next < list.count && list.enters[next] != enters && list.t[next] - list.t[i] <= list.slack;
        segments.flags |= is_wrong && !is_skipped && !list.is_on_edge[i] ? CORE_RAY_INCONSISTENT : 0u;
        if (leaves && is_inside && list.t[i] > entered && segments.count < CORE_RAY_MAX_CROSSINGS / 2u) {
            segments.enter[segments.count] = entered;
            segments.leave[segments.count] = list.t[i];
            segments.count += 1u;
        }
        entered = enters && !is_inside ? list.t[i] : entered;
        is_inside = is_wrong ? is_inside : (is_inside || enters) && !leaves;
    }
    segments.flags |= is_inside ? CORE_RAY_INCONSISTENT : 0u;
    return segments;
}

// A line, and two directions across it.
struct core_line {
    elvis_vec3 origin, direction, e1, e2;
};

core_line core_line_of(elvis_vec3 origin, elvis_vec3 direction) {
    const elvis_vec3 axis = abs(direction.x) < elvis_real(0.6LF) ? elvis_vec3(1, 0, 0) : elvis_vec3(0, 1, 0);
    const elvis_vec3 e1 = normalize(cross(direction, axis));
    return core_line(origin, direction, e1, cross(direction, e1));
}

// Newton's step by Cramer's rule, and what rounding of positions makes of it.
struct core_face_step {
    elvis_real ds, dr, step;
    // Of s and r; of t; of the face, and how far from the line the point is.
    elvis_real error, t_error, size, distance;
    bool is_regular;
    elvis_real t;
    bool enters;
};

core_face_step core_step_on_face(uint element, core_face face, core_line line, elvis_real s, elvis_real r) {
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, face.corner + s * face.a + r * face.b, x, jacobian);
    const elvis_vec3 along_a = jacobian * face.a, along_b = jacobian * face.b, offset = x - line.origin;
    const elvis_real f1 = dot(line.e1, offset), f2 = dot(line.e2, offset);
    const elvis_real a1 = dot(line.e1, along_a), a2 = dot(line.e2, along_a);
    const elvis_real b1 = dot(line.e1, along_b), b2 = dot(line.e2, along_b);
    const elvis_real det = a1 * b2 - a2 * b1;
    core_face_step here;
    here.size = core_max_norm(along_a) + core_max_norm(along_b);
    here.distance = max(abs(f1), abs(f2));
    here.is_regular = abs(det) > elvis_real(64) * CORE_ROUNDOFF * here.size * here.size;
    const elvis_real inverse = here.is_regular ? elvis_real(1) / det : elvis_real(0);
    here.ds = (f2 * b1 - f1 * b2) * inverse;
    here.dr = (f1 * a2 - f2 * a1) * inverse;
    here.step = max(abs(here.ds), abs(here.dr));
    const elvis_real noise = elvis_real(4) * CORE_ROUNDOFF * (core_max_norm(x) + core_max_norm(line.origin) + here.size);
    here.error = noise * here.size * abs(inverse) + elvis_real(4) * CORE_ROUNDOFF;
    here.t_error = elvis_real(4) * (here.error * here.size + noise);
    here.t = dot(line.direction, offset + here.ds * along_a + here.dr * along_b) / dot(line.direction, line.direction);
    here.enters = face.orientation * sign(determinant(jacobian)) * dot(cross(along_a, along_b), line.direction) < elvis_real(0);
    return here;
}

// Segments of the line origin + t direction, |direction| = 1, in one element. Positions as elvis_mapping gives them.
core_ray_segments core_intersect_ray(uint element, elvis_vec3 origin, elvis_vec3 direction) {
    const elvis_real patches = elvis_real(CORE_RAY_PATCHES), half_one = elvis_real(0.5LF);
    const core_line line = core_line_of(origin, direction);
    core_face_crossings list;
    list.count = 0u;
    list.flags = 0u;
    list.slack = elvis_real(0);

    // One evaluation an iteration, whatever the start and its step: lanes do not wait for each other.
    uint start = 0u, steps = 0u;
    elvis_real s = half_one / patches, r = s;
    for (uint work = 0u; work < CORE_RAY_WORK && start < CORE_RAY_STARTS; ++work) {
        const core_face face = core_face_frame(int(start / uint(CORE_RAY_PATCHES * CORE_RAY_PATCHES)));
        const core_face_step here = core_step_on_face(element, face, line, s, r);
        const elvis_real excess = core_face_excess(s + here.ds, r + here.dr, face.is_triangle);

        // What becomes of this start.
        const bool is_first = steps == 0u, is_last = steps + 1u == CORE_RAY_STEPS;
        const bool has_converged = here.is_regular && (here.step <= here.error || (is_last && here.step <= elvis_real(64) * here.error));
        const bool starts_elsewhere = is_first && (!here.is_regular || here.step * patches > elvis_real(1.5LF));
        const bool has_left = steps >= 3u && excess > elvis_real(0.1LF);
        const bool ends = has_converged || starts_elsewhere || has_left || is_last;
        if (has_converged && excess <= elvis_real(2) * here.error) {
            core_add_face_crossing(list, here.t, here.enters, excess >= elvis_real(-8) * here.error, here.t_error);
        }
        // Did not end although the ray passes close by: within 1e-4 of the face's size.
        const bool is_near = here.distance <= elvis_real(1.0e-4LF) * here.size && excess < elvis_real(0.05LF);
        list.flags |= is_last && !has_converged && is_near ? CORE_RAY_FAILED : 0u;

        start += ends ? 1u : 0u;
        steps = ends ? 0u : steps + 1u;
        const uint patch_number = start % uint(CORE_RAY_PATCHES * CORE_RAY_PATCHES);
        const elvis_real start_s = (elvis_real(patch_number % uint(CORE_RAY_PATCHES)) + half_one) / patches;
        const elvis_real start_r = (elvis_real(patch_number / uint(CORE_RAY_PATCHES)) + half_one) / patches;
        // Steps of more than half a face are cut, and points kept near the face: beyond it the mapping need not be one to one.
        const elvis_real cut = here.step > half_one ? half_one / here.step : elvis_real(1);
        s = ends ? start_s : clamp(s + cut * here.ds, elvis_real(-0.2LF), elvis_real(1.2LF));
        r = ends ? start_r : clamp(r + cut * here.dr, elvis_real(-0.2LF), elvis_real(1.2LF));
    }
    list.flags |= start < CORE_RAY_STARTS ? CORE_RAY_WORK_LIMIT : 0u;
    return core_pair_crossings(list);
}

#endif
