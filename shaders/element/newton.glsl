// Newton's method for the inverse of the mapping: xi with x(xi) = target.
//
// Each step evaluates the mapping at a point of the element and predicts the solution from the linear model there,
//     prediction = xi + J(xi)^-1 (target - x(xi)).
// The next step evaluates at the prediction, moved into the element if it lies outside: only there is the mapping known to be
// one to one, and extrapolated polynomials fold. So a solution on a face, or beyond it by rounding, is found to full accuracy,
// and a point outside shows as predictions that agree with each other about lying outside.
//
// Ends:
//   converged  the next step would change the prediction by less than rounding does
//   outside    the prediction violates a face constraint by more than its error can be (is_certain); or by far more than it changed
//              between two evaluations; or does so in the end from every start
//   failed     neither within the allowed steps, from several starts: no answer, to be counted, never to be drawn
//
// State is kept in scalars because of a driver that miscompiles vectors carried round a loop.

#include "element/element_frame.glsl"
#include "element/prediction.glsl"
#include "element/shape_region.glsl"

#define CORE_NEWTON_RUNNING 0u
#define CORE_NEWTON_CONVERGED 1u
#define CORE_NEWTON_OUTSIDE 2u
#define CORE_NEWTON_FAILED 3u

// Steps from one start. From a start of first order, eight quadratically convergent steps pass any precision; more are needed
// only while far away on a strongly curved element.
#define CORE_NEWTON_STEPS 12u
#define CORE_NEWTON_STARTS 5u

// Predictions farther beyond a pyramid's apex are not of the apex itself; and how far below it the mapping is evaluated then, as a
// share of the way to the centroid.
#define CORE_APEX_MARGIN elvis_real(1e-3LF)
#define CORE_BELOW_APEX elvis_real(0.125LF)

struct core_newton {
    // Prediction of the solution, which may lie outside.
    elvis_real x, y, z;
    // Length of the last step that started from a prediction; negative if there is none yet.
    elvis_real last_step;
    elvis_real curvature;
    uint steps;
    uint start;
    // Steps in a row, of this start, whose prediction lay clearly outside; and whether every start so far ended so.
    uint outside_steps;
    bool always_outside;
    // The last prediction lay outside by more than the curvature lets it be off: if that holds, no solution lies in the element.
    bool is_certain;
};

// What the last step knows beyond the state.
struct core_inverse {
    // Rows of J^-1.
    elvis_vec3 row0, row1, row2;
    // Rounding error of each coordinate of the solution.
    elvis_real error0, error1, error2;
};

// `guess_step`: length of the step of first order that led to the guess; negative if none did.
core_newton core_newton_begin(elvis_real guess_x, elvis_real guess_y, elvis_real guess_z, elvis_real guess_step,
                              elvis_real curvature) {
    core_newton state;
    state.curvature = curvature;
    state.x = guess_x;
    state.y = guess_y;
    state.z = guess_z;
    state.last_step = guess_step;
    state.steps = 0u;
    state.start = 0u;
    state.outside_steps = 0u;
    state.always_outside = true;
    state.is_certain = false;
    return state;
}

void core_newton_restart(inout core_newton state) {
    // The first start takes whole steps and can go round in circles: it says nothing.
    state.always_outside = state.start == 0u || (state.always_outside && state.outside_steps >= 3u);
    state.start += 1u;
    // The other starts lie on the half way from the centroid to the corners of a tetrahedron in the shape, lowest corner first.
    const uint k = state.start & 3u;
    const elvis_vec3 c = CORE_CENTROID;
    const elvis_real half_way = elvis_real(0.5LF);
    state.x = c.x + half_way * ((k == 2u ? elvis_real(1) : elvis_real(-1)) - c.x);
    state.y = c.y + half_way * ((k == 3u ? elvis_real(1) : elvis_real(-1)) - c.y);
    state.z = c.z + half_way * ((k == 0u ? elvis_real(1) : elvis_real(-1)) - c.z);
    state.last_step = elvis_real(-1);
    state.steps = 0u;
    state.outside_steps = 0u;
}

// Where to evaluate next. Far predictions are of no use but for their direction, and could overflow. After the first start, steps towards a
// prediction that is clearly outside go half the way: on strongly curved elements whole ones can lead from one side to the other and back.
void core_newton_move(elvis_vec3 xi, elvis_vec3 next, elvis_real excess, bool is_regular, inout core_newton state) {
    const elvis_real limit = elvis_real(16), half_way = elvis_real(0.5LF);
    const bool is_damped = state.start > 0u && excess > elvis_real(0.125LF);
    elvis_real inside_x = next.x, inside_y = next.y, inside_z = next.z;
    core_project(inside_x, inside_y, inside_z);
    state.x = is_regular ? (is_damped ? half_way * (xi.x + inside_x) : clamp(next.x, -limit, limit)) : xi.x;
    state.y = is_regular ? (is_damped ? half_way * (xi.y + inside_y) : clamp(next.y, -limit, limit)) : xi.y;
    state.z = is_regular ? (is_damped ? half_way * (xi.z + inside_z) : clamp(next.z, -limit, limit)) : xi.z;
    state.steps += 1u;
    state.outside_steps = is_regular && excess > elvis_real(1e-3LF) ? state.outside_steps + 1u : 0u;
}

// One step. `position_error`: absolute error that target and positions carry beyond the rounding of numbers of the element's
// size. Where the result is converged or outside, state.x, y, z is the last prediction.
uint core_newton_step(uint element, elvis_vec3 target, elvis_real position_error, inout core_newton state,
                      out core_inverse inverse) {
    elvis_real x = state.x, y = state.y, z = state.z;
    core_project(x, y, z);
#if ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
    // At the apex mappings need not be smooth: what is predicted there of points elsewhere says nothing, and leads back there.
    const bool is_beyond_apex = z >= elvis_real(1) && core_excess(state.x, state.y, state.z) > CORE_APEX_MARGIN;
    x = is_beyond_apex ? mix(x, CORE_CENTROID.x, CORE_BELOW_APEX) : x;
    y = is_beyond_apex ? mix(y, CORE_CENTROID.y, CORE_BELOW_APEX) : y;
    z = is_beyond_apex ? mix(z, CORE_CENTROID.z, CORE_BELOW_APEX) : z;
#endif
    const bool was_inside = x == state.x && y == state.y && z == state.z;
    const elvis_vec3 xi = elvis_vec3(x, y, z);
    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, position, jacobian);
    const core_frame frame = core_frame_at(position, jacobian, position_error);
    inverse = core_inverse(frame.row0, frame.row1, frame.row2, frame.xi_error.x, frame.xi_error.y, frame.xi_error.z);

    const elvis_vec3 way = core_to_xi(frame, target - position), next = xi + way;
    const elvis_real step = core_max_norm(way), change = core_max_norm(next - elvis_vec3(state.x, state.y, state.z));
    const elvis_real tolerance = core_max_norm(frame.xi_error), excess = core_excess(next.x, next.y, next.z);
    const bool has_change = state.last_step >= elvis_real(0), is_regular = core_is_finite(step);

    // Quadratic convergence: |s_k+1| ~ C |s_k|^2 with C = |s_k| / |s_k-1|^2, if both steps started at predictions. Asking a quarter
    // of the rounding keeps a factor for the estimate; the change itself is the criterion where the estimate does not apply. C
    // depends on the direction of the steps and can come out far too small: it is taken to be at least 1, which bounds the element's
    // curvature where one is known, and at least 16 elsewhere.
    const elvis_real least_curvature = state.curvature <= elvis_real(1) ? elvis_real(1) : elvis_real(16);
    const bool is_predicted = was_inside && step * step * least_curvature <= tolerance &&
                              step * step * step <= elvis_real(0.25LF) * tolerance * state.last_step * state.last_step;
    const bool converged = is_regular && ((has_change && is_predicted) || (has_change && change <= tolerance));
    const elvis_real rounding = elvis_real(2) * CORE_CONSTRAINT_NORM * tolerance;
    // Points of the shape are no farther from there.
    const elvis_real off = core_prediction_error_within(state.curvature, step, elvis_real(1) + core_max_norm(xi));
    state.is_certain = is_regular && excess > CORE_CONSTRAINT_NORM * off + rounding;
    const bool is_steady = is_regular && has_change && state.steps > 0u && excess > elvis_real(8) * change + rounding;
    const bool outside = state.is_certain || is_steady;
    core_newton_move(xi, next, excess, is_regular, state);
    state.last_step = step;

    if (converged) {
        return CORE_NEWTON_CONVERGED;
    }
    if (outside) {
        return CORE_NEWTON_OUTSIDE;
    }
    if (is_regular && state.steps < CORE_NEWTON_STEPS) {
        return CORE_NEWTON_RUNNING;
    }
    core_newton_restart(state);
    // Predictions that never settle but always point out of the element, from wherever they start, say outside.
    const uint spent = state.always_outside ? CORE_NEWTON_OUTSIDE : CORE_NEWTON_FAILED;
    return state.start >= CORE_NEWTON_STARTS ? spent : CORE_NEWTON_RUNNING;
}
