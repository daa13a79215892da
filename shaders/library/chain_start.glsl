// Whether a ray can come into an element through one of its faces without neighbour, from the linearized mapping alone
// (library/linearization.glsl), without any evaluation.
//
// At each point of the element the change of its reference coordinates along the ray is that of the linearized mapping but for a
// share of 2 C R / (1 - 2 C R), with the curvature C (library/prediction.glsl) and the shape's radius R. So a ray surely leaves
// through some faces, if it meets them at all; and where it surely enters through one it does so once, as the way between two points
// of the shape lies in it. Others it can meet only where the face's constraint may be zero and the others may hold.
//
// The kernel brings library/ray_part.glsl and core_links.

// Of a matrix of 16-bit fractions, over the largest entry of a row.
#define CORE_START_MATRIX_ERROR elvis_real(1e-4LF)
// Steepness with which a ray leaves through a face, over that of its coordinates: parts behind edges that are near within rounding are then
// too short to matter.
#define CORE_START_STEEPNESS elvis_real(0.05LF)
// Share by which coordinates may change otherwise: beyond it nothing is told.
#define CORE_START_BEND elvis_real(0.5LF)

// In [begin, end], where the ray meets the element's box. `from`: starts before it do not count; `is_taken`: the start there is one through
// a face of this element.
bool core_may_start(core_walk_ray ray, uint element, elvis_real begin, elvis_real end, elvis_real from, bool is_taken) {
    const core_linearization linearization = core_fetch_linearization(element);
    const elvis_vec3 first = core_part_target(ray, element, begin);
    const elvis_vec3 here = elvis_vec3(core_linear_inverse(linearization, vec3(first)));
    const elvis_vec3 there = elvis_vec3(core_linear_inverse(linearization, vec3(first + ray.reach * ray.direction)));
    const elvis_vec3 slope = (there - here) / ray.reach;
    const elvis_real curvature = CORE_PART_CURVATURE(element);
    const elvis_real share = elvis_real(2) * curvature * CORE_SHAPE_RADIUS;
    const bool is_known = linearization.exponents != 0u && share <= CORE_START_BEND;
    const float scale = max(max(core_scale(linearization.exponents, 0), core_scale(linearization.exponents, 1)),
                            core_scale(linearization.exponents, 2));
    const elvis_real size = core_max_norm(slope);
    const elvis_real bend = size * share / (elvis_real(1) - min(share, CORE_START_BEND)) +
                            CORE_START_MATRIX_ERROR * elvis_real(scale) * dot(abs(ray.direction), elvis_vec3(1));
    const elvis_real error = curvature * CORE_SHAPE_RADIUS * CORE_SHAPE_RADIUS + CORE_START_ERROR;

    // Where all constraints may hold; where the ray may meet the faces without neighbour.
    elvis_real possible_from = max(begin, from - elvis_real(2) * ray.tolerance) - begin, possible_to = end - begin;
    elvis_real open_from = CORE_FAR, open_to = -CORE_FAR;
    uint n_open = 0u, n_once = 0u;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_real norm = dot(abs(constraint.xyz), elvis_vec3(1));
        const elvis_real rate = dot(constraint.xyz, slope), value = dot(constraint.xyz, here) + constraint.w;
        const elvis_real steepness = max(abs(rate), elvis_real(1e-30LF));
        const elvis_real middle = (rate < elvis_real(0) ? value : -value) / steepness, reach = norm * error / steepness;
        possible_to = rate > elvis_real(0) ? min(possible_to, middle + reach) : possible_to;
        possible_from = rate < elvis_real(0) ? max(possible_from, middle - reach) : possible_from;
        const bool is_left = rate - norm * bend > CORE_START_STEEPNESS * norm * size;
        const bool is_open = elvis_fetch_core_links(element, uint(face)) == CORE_NO_LINK && !is_left;
        open_from = is_open ? min(open_from, middle - reach) : open_from;
        open_to = is_open ? max(open_to, middle + reach) : open_to;
        n_open += is_open ? 1u : 0u;
        n_once += is_open && rate + norm * bend < elvis_real(0) ? 1u : 0u;
    }
    const bool is_met = max(possible_from, open_from) <= min(possible_to, open_to);
    return !is_known || (is_met && !(is_taken && n_open == 1u && n_once == 1u));
}
