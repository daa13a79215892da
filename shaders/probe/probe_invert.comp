// Inverse mapping for probing: one query (element, position) an invocation, always in double precision.

#include "element/newton.glsl"
#include "element/inside.glsl"

layout(local_size_x = 32) in;

// `x`, `y`, `z`: position in world coordinates.
struct core_query {
    double x, y, z;
    uint element;
    uint unused;
};

// `error`: rounding error of xi, in reference units. `status`: as core_newton_step returns it.
struct core_answer {
    double x, y, z;
    double error;
    uint status;
    uint unused;
};

layout(set = 0, binding = 0, std430) readonly buffer core_queries_block { core_query core_queries[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_answers_block { core_answer core_answers[]; };
layout(push_constant) uniform core_parameters {
    // Rounding of positions in world coordinates.
    double core_position_error;
    uint core_n_queries;
};

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_queries) {
        return;
    }
    const uint element = core_queries[index].element;
    const elvis_vec3 target =
        elvis_vec3(core_queries[index].x, core_queries[index].y, core_queries[index].z) - elvis_origin(element);
    const elvis_vec3 start = CORE_CENTROID;
    core_newton state = core_newton_begin(start.x, start.y, start.z, elvis_real(-1), CORE_UNKNOWN_CURVATURE);
    core_inverse inverse_jacobian;
    uint status = CORE_NEWTON_RUNNING;
    elvis_real error = elvis_real(0);
    for (uint i = 0u; i < CORE_NEWTON_STARTS * CORE_NEWTON_STEPS && status == CORE_NEWTON_RUNNING; ++i) {
        status = core_newton_step(element, target, core_position_error, state, inverse_jacobian);
        error = max(max(inverse_jacobian.error0, inverse_jacobian.error1), inverse_jacobian.error2);
    }
#if ELVIS_HAS_INSIDE
    // As near as the host allows beside a face (core/probe/point_evaluator.hpp).
    const elvis_vec3 xi = elvis_vec3(state.x, state.y, state.z);
    const bool is_within = core_is_within(element, xi, elvis_vec3(error + elvis_real(1e-10LF)));
    status = status == CORE_NEWTON_CONVERGED && !is_within ? CORE_NEWTON_OUTSIDE : status;
#endif
    core_answers[index].x = state.x;
    core_answers[index].y = state.y;
    core_answers[index].z = state.z;
    core_answers[index].error = error;
    core_answers[index].status = status;
}
