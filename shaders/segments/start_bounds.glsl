// Whether a ray can come into an element through one of its faces without neighbour, from the linearized mapping alone, without any
// evaluation.
//
// A ray that surely enters through a face does so once: in elements that are nearly linear, because the way between two points of the
// shape lies in it; in others, because a face whose normals lie within a cone cannot overlap itself as seen along the ray, except if it
// winds like a spiral staircase. Through other faces it can enter only where the face's constraint may be zero and the others may hold.
//
// The kernel brings segments/segment.glsl and core_links.

#include "segments/ray_motion.glsl"

// In [begin, end], where the ray meets the element's box. `from`: starts before it do not count; `is_taken`: the start there is that of the
// last walk, through a face of this element.
bool core_may_start(core_traced_ray ray, uint element, elvis_real begin, elvis_real end, elvis_real from, bool is_taken) {
    const core_linearization linearization = core_fetch_linearization(element);
    const elvis_real curvature = CORE_SEGMENT_CURVATURE(element);
    const core_ray_motion motion = core_motion_along(linearization, curvature, ray.direction);
    const elvis_vec3 here = elvis_vec3(core_linear_inverse(linearization, vec3(core_segment_target(ray, element, begin))));
    const elvis_real error = curvature * CORE_SHAPE_RADIUS * CORE_SHAPE_RADIUS + CORE_START_ERROR;
    // Where all constraints may hold; where the ray may meet the faces without neighbour through which it may enter.
    elvis_real possible_from = max(begin, from - elvis_real(2) * ray.tolerance) - begin, possible_to = end - begin;
    elvis_real face_from = elvis_real(3e38LF), face_to = elvis_real(-3e38LF);
    uint n_faces = 0u, n_once = 0u;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_real norm = dot(abs(constraint.xyz), elvis_vec3(1));
        const elvis_real rate = dot(constraint.xyz, motion.slope), value = dot(constraint.xyz, here) + constraint.w;
        const elvis_real steepness = max(abs(rate), elvis_real(1e-30LF));
        const elvis_real middle = (rate < elvis_real(0) ? value : -value) / steepness, reach = norm * error / steepness;
        possible_to = rate > elvis_real(0) ? min(possible_to, middle + reach) : possible_to;
        possible_from = rate < elvis_real(0) ? max(possible_from, middle - reach) : possible_from;
        const bool may_enter = elvis_fetch_core_links(element, uint(face)) == CORE_NO_LINK && !core_surely_leaves(motion, element, face);
        face_from = may_enter ? min(face_from, middle - reach) : face_from;
        face_to = may_enter ? max(face_to, middle + reach) : face_to;
        n_faces += may_enter ? 1u : 0u;
        n_once += may_enter && core_surely_enters(motion, element, face) ? 1u : 0u;
    }
    const bool is_met = max(possible_from, face_from) <= min(possible_to, face_to);
    // The element's own boundary (element/inside.glsl) is anywhere in it.
    return ELVIS_HAS_INSIDE == 1 || linearization.exponents == 0u || (is_met && !(is_taken && n_faces == 1u && n_once == 1u));
}
