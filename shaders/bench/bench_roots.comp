// The first root of each of many polynomials, given by Chebyshev coefficients, on [0, 1]: by the Bernstein form or, with
// CORE_COLLEAGUE, by eigenvalues. Three numbers each: the first crossing (2 where there is none, 3 where the method gave up), and between
// what ends the touches before it lie (2 and 0 where there is none).

elvis_real core_listed_value(uint i) { return elvis_real(0); }

#include "arithmetic/read_only.glsl"
#include "segments/polynomial.glsl"
#include "segments/colleague.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) CORE_READ_REALS(core_input);
layout(set = 0, binding = 1, std430) writeonly buffer core_output_block { elvis_real core_output[]; };
layout(push_constant) uniform core_parameters { uint core_n_polynomials; };

void main() {
    const uint at = gl_GlobalInvocationID.x;
    if (at >= core_n_polynomials) {
        return;
    }
    core_polynomial chebyshev;
    for (int k = 0; k < CORE_FIT_SIZE; ++k) {
        chebyshev.c[k] = CORE_REAL(core_input, at * CORE_FIT_SIZE + uint(k));
    }
    elvis_real root_t = elvis_real(2), touch_from = elvis_real(2), touch_to = elvis_real(0);
#if CORE_COLLEAGUE
    const core_colleague_root root = core_first_root_by_colleague(chebyshev, elvis_real(0), elvis_real(0));
    root_t = root.has_failed ? elvis_real(3) : root.t;
#else
    const core_polynomial bernstein = core_to_bernstein(chebyshev);
    const elvis_real error = core_bernstein_rounding(chebyshev);
    core_isolation isolation = core_isolation_begin();
    while (root_t > elvis_real(1) && !core_isolation_is_over(isolation)) {
        const core_crossing crossing = core_next_crossing(bernstein, error, 1u, isolation);
        const bool is_touch = crossing.kind == CORE_CROSSING_TOUCH;
        touch_from = is_touch ? min(touch_from, crossing.lower) : touch_from;
        touch_to = is_touch ? crossing.upper : touch_to;
        root_t = is_touch || crossing.kind == CORE_CROSSING_NONE ? root_t : crossing.t;
    }
#endif
    core_output[3u * at] = root_t;
    core_output[3u * at + 1u] = touch_from;
    core_output[3u * at + 2u] = touch_to;
}
