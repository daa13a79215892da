// Whether an element holds the point of a ray at a parameter, for certain as far as the curvature bounds the mapping
// (element/prediction.glsl).
//
// In a box of reference coordinates Newton's method begins at the centre. Each evaluation, at xi, predicts the point. No point of the box
// is farther than R from xi, so that the prediction is off by at most C R^2, with the curvature C. That tells
//
//   the box, or the shape, is farther from the prediction than that   it does not hold the point
//   4 C R <= 1                                                      the Jacobian changes by half of itself at most: the mapping is one to
//                                                                     one there, and where Newton's method ends is all that there is
//   else                                                             the box is cut in eight
//
// The first box is the cube around the shape. In nearly linear elements there is no other one.
//
// The kernel brings segments/segment.glsl.

#ifndef CORE_POINT_SEARCH
#define CORE_POINT_SEARCH

#include "element/octree_box.glsl"

#define CORE_POINT_OUTSIDE 0u
#define CORE_POINT_FOUND 1u
#define CORE_POINT_UNDECIDED 2u

// Newton steps in a box, after which it is cut, and how often; evaluations in all.
#define CORE_POINT_STEPS 8u
#define CORE_POINT_LEVELS 8u
#define CORE_POINT_EVALUATIONS 400u
// Coordinates of rays are rounded by a share of their bound.
#define CORE_POINT_SLACK (elvis_real(1) / CORE_ROUNDING_SHARE)

struct core_point_search {
    uint status, n_evaluations;
    // Rests on a curvature that is not known.
    bool is_estimated;
    // The point, or where the last evaluation predicts it; rounding of its coordinates.
    core_ray_point at;
    elvis_real noise;
};

core_point_search core_search_point(const core_traced_ray ray, uint element, elvis_real t) {
    const elvis_real of_element = CORE_SEGMENT_CURVATURE(element);
    core_octree_box box = core_whole_box();
    core_point_search search =
        core_point_search(CORE_POINT_OUTSIDE, 0u, false, core_ray_point_at(t, CORE_CENTROID, elvis_vec3(0)), elvis_real(0));
    elvis_real x = CORE_CENTROID.x, y = CORE_CENTROID.y, z = CORE_CENTROID.z;
    uint steps = 0u;
    while (!box.is_last) {
        const elvis_vec3 xi = elvis_vec3(x, y, z), middle = core_middle(box);
        const core_ray_evaluation here = core_evaluate_ray(ray, element, xi, t);
        const bool is_proven = core_proven_curvature_at(element, here.frame) < CORE_UNKNOWN_CURVATURE;
        const elvis_real curvature =
            core_curvature_at(element, here.frame, is_proven ? of_element : min(of_element, CORE_ASSUMED_CURVATURE));
        search.is_estimated = search.is_estimated || (!is_proven && of_element > CORE_ASSUMED_CURVATURE);
        const elvis_vec3 at = here.model.at;
        const elvis_real half_side = core_half_side(box), reach = core_max_norm(xi - middle) + half_side;
        const elvis_real size = core_max_norm(here.model.newton_step), noise = CORE_POINT_SLACK * core_max_norm(here.model.noise);
        const elvis_real beyond = core_excess(at.x, at.y, at.z) / CORE_CONSTRAINT_NORM;
        const elvis_real off = max(core_max_norm(at - middle) - half_side, beyond);
        const elvis_real excess_of_box = core_excess(middle.x, middle.y, middle.z) / CORE_CONSTRAINT_NORM;
        const bool is_excluded = excess_of_box > half_side || (here.is_sound && off > curvature * reach * reach + noise);
        const bool is_there = here.is_sound && core_is_near(curvature, size) && core_prediction_error(curvature, size) <= noise;
        const bool is_found = is_there && beyond <= noise && excess_of_box <= half_side;
        const bool is_single = elvis_real(4) * curvature * reach <= elvis_real(1);
        const bool is_settled = is_excluded || (is_there && is_single);
        search.n_evaluations += 1u;
        steps += 1u;
        const bool is_given_up = box.level >= CORE_POINT_LEVELS || search.n_evaluations >= CORE_POINT_EVALUATIONS;
        const bool is_stuck = !is_settled && (is_there || !here.is_sound || steps >= CORE_POINT_STEPS);
        search.at = core_either(here.is_sound, core_ray_point_at(t, at, here.model.slope), search.at);
        search.noise = noise;
        search.status = is_found ? CORE_POINT_FOUND : is_stuck && is_given_up ? CORE_POINT_UNDECIDED : search.status;
        box.is_last = search.n_evaluations >= CORE_POINT_EVALUATIONS || is_found;
        if (!box.is_last && is_stuck && !is_given_up) {
            core_cut_box(box);
        } else if (!box.is_last && (is_settled || is_stuck)) {
            core_leave_box(box);
        }
        steps = is_settled || is_stuck ? 0u : steps;
        const elvis_vec3 next = is_settled || is_stuck ? core_middle(box) : at;
        x = next.x;
        y = next.y;
        z = next.z;
        core_project(x, y, z);
        if (box.is_last) {
            break;
        }
    }
    return search;
}

#endif
