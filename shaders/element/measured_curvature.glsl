// The curvature of element/prediction.glsl in a part of an element: how much the Jacobian changes between points of it.

#ifndef CORE_MEASURED_CURVATURE
#define CORE_MEASURED_CURVATURE

#include "arithmetic/finite.glsl"
#include "element/shape_region.glsl"

// Slopes are measured between points, and are steeper elsewhere: what the factor is for.
#define CORE_CURVATURE_SAFETY elvis_real(2)
// Of the ways across a whole element.
#define CORE_CURVATURE_STAGES 2u
// Where an element folds.
#define CORE_FOLDED_SLOPE elvis_real(1e6LF)

// Maximum norm of a^-1 (b - c), with a^-1 by its cofactors over the determinant.
elvis_real core_relative_change(elvis_mat3 a, elvis_mat3 b, elvis_mat3 c) {
    const elvis_vec3 cofactors0 = cross(a[1], a[2]), cofactors1 = cross(a[2], a[0]), cofactors2 = cross(a[0], a[1]);
    const elvis_vec3 d0 = b[0] - c[0], d1 = b[1] - c[1], d2 = b[2] - c[2];
    const elvis_real sum0 = abs(dot(cofactors0, d0)) + abs(dot(cofactors0, d1)) + abs(dot(cofactors0, d2));
    const elvis_real sum1 = abs(dot(cofactors1, d0)) + abs(dot(cofactors1, d1)) + abs(dot(cofactors1, d2));
    const elvis_real sum2 = abs(dot(cofactors2, d0)) + abs(dot(cofactors2, d1)) + abs(dot(cofactors2, d2));
    return max(max(sum0, sum1), sum2) / abs(dot(a[0], cofactors0));
}

// The box of the positions that were looked at.
elvis_vec3 core_seen_lower, core_seen_upper;

// From the Jacobians on the way from a point of the element, with the Jacobian there, to the corners, and the middles of edges and
// faces of a cube, as far as that lies in the element. `n_stages`: points on each way, for large parts. `turn`: how much the Jacobian
// changes on these ways, by the sums of its rows.
elvis_real core_measured_curvature(uint element, elvis_vec3 from, elvis_mat3 jacobian, elvis_vec3 middle, elvis_real half_side,
                                   uint n_stages, out elvis_vec3 turn) {
    const elvis_real determinant = dot(jacobian[0], cross(jacobian[1], jacobian[2]));
    elvis_real steepest = elvis_real(0);
    core_seen_lower = elvis_vec3(3e38);
    core_seen_upper = elvis_vec3(-3e38);
    turn = elvis_vec3(0);
    for (int place = 0; place < 27; ++place) {
        elvis_real x = middle.x + half_side * elvis_real(place % 3 - 1);
        elvis_real y = middle.y + half_side * elvis_real(place / 3 % 3 - 1);
        elvis_real z = middle.z + half_side * elvis_real(place / 9 - 1);
        core_project(x, y, z);
        const elvis_vec3 way = (elvis_vec3(x, y, z) - from) / elvis_real(n_stages);
        const elvis_real distance = max(max(abs(way.x), abs(way.y)), abs(way.z));
        elvis_mat3 before = jacobian;
        for (uint stage = 1u; stage <= n_stages; ++stage) {
            elvis_vec3 position;
            elvis_mat3 here;
            elvis_mapping_jacobian(element, from + elvis_real(stage) * way, position, here);
            here = core_full_jacobian(here);
            core_seen_lower = min(core_seen_lower, position);
            core_seen_upper = max(core_seen_upper, position);
            turn = max(turn, abs(here[0] - jacobian[0]) + abs(here[1] - jacobian[1]) + abs(here[2] - jacobian[2]));
            const elvis_real change = max(core_relative_change(jacobian, here, before), core_relative_change(here, here, before));
            const bool is_sound = dot(here[0], cross(here[1], here[2])) * determinant > elvis_real(0) && core_is_finite(change);
            steepest = distance > elvis_real(0) ? max(steepest, is_sound ? change / distance : CORE_FOLDED_SLOPE) : steepest;
            before = here;
        }
    }
    return CORE_CURVATURE_SAFETY * elvis_real(0.5LF) * steepest;
}

#endif
