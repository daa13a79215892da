// How the integral along a segment is found. An integrator is a struct core_integral, which says where it wants samples of the field, and
//
//     core_integral integral = core_integral_begin(from, to, per_parameter, step);
//     while (integral.wants != CORE_WANTS_NOTHING) {
//         while (core_integral_wants_sample(integral)) {
//             (take a sample at core_integral_at(integral), for a line over core_integral_span(integral));
//             core_integral_add(integral, ...);
//         }
//         core_integrate_step(integral, ...);
//     }
//
// `step`: how long the first one may be, in the ray's parameter.

// CORE_INTEGRATOR, as elvis::Integrator (core/render/volume_rendering.hpp).
#define CORE_INTEGRATOR_RIEMANN 0
#define CORE_INTEGRATOR_TRAPEZOID 1
#define CORE_INTEGRATOR_CATEGORIES 2
#define CORE_INTEGRATOR_ADAPTIVE_TRAPEZOID 3
#define CORE_INTEGRATOR_EXACT 4
#define CORE_IS_EXACT (CORE_INTEGRATOR == CORE_INTEGRATOR_EXACT)

#define CORE_WANTS_NOTHING 0u
// A sample's share of what the kernel does in one dispatch.
#define CORE_WORK_A_SAMPLE (CORE_IS_EXACT ? 1u : 3u)

// What the integral along a segment is to be.
struct core_accuracy {
    // Length of the ray for its parameter.
    elvis_real per_parameter;
    // What each channel may be off in the end; how long the ray may go on at most, from the beginning of the segment.
    elvis_real tolerance, ahead;
    // Error of the field that is good enough.
    elvis_real enough;
};

#if CORE_INTEGRATOR == CORE_INTEGRATOR_RIEMANN || CORE_INTEGRATOR == CORE_INTEGRATOR_TRAPEZOID
#include "volume/volume_steps.glsl"
#elif CORE_INTEGRATOR == CORE_INTEGRATOR_CATEGORIES
#include "volume/volume_categories.glsl"
#elif CORE_INTEGRATOR == CORE_INTEGRATOR_ADAPTIVE_TRAPEZOID
#include "volume/volume_adaptive.glsl"
#elif CORE_INTEGRATOR == CORE_INTEGRATOR_EXACT
#include "volume/volume_exact.glsl"
#include "volume/volume_polynomials.glsl"
#else
#error "CORE_INTEGRATOR is none of CORE_INTEGRATOR_..."
#endif

#if !CORE_IS_EXACT
// All of a segment is done at once, and with each sample what it allows.
bool core_integral_may_stop(core_integral integral) { return false; }
bool core_integral_wants_sample(core_integral integral) { return integral.wants != CORE_WANTS_NOTHING; }
elvis_real core_integral_done(core_integral integral) { return integral.from; }
elvis_real core_integral_step(core_integral integral) { return CORE_FAR; }
#if CORE_INTEGRATOR != CORE_INTEGRATOR_CATEGORIES
elvis_real core_integral_span(core_integral integral) { return elvis_real(0); }
#endif
#endif
