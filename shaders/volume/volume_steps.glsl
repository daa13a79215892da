// The volume rendering integral along a segment by steps of equal length, no longer than core_step_length: as it is done
// where the breakpoints of the transfer function are not known (B. Nelson, 2012, chapter 6). Riemann's sums take both integrals to
// first order, the trapezoidal rule to second, where no step has more than one breakpoint.
//
// The kernel brings volume/volume_light.glsl and segments/ray_sample.glsl.

#include "volume/volume_optics.glsl"

#define CORE_WANTS_VALUE 1u

struct core_integral {
    elvis_real from, to;
    uint wants;
    // Steps; samples taken.
    uint n_steps, n_samples;
    // At the last sample.
    core_optics last;
    uint n_breakpoints;
};

core_integral core_integral_begin(elvis_real from, elvis_real to, elvis_real per_parameter, elvis_real step) {
    core_integral integral;
    integral.from = from;
    integral.to = to;
    integral.wants = from < to ? CORE_WANTS_VALUE : CORE_WANTS_NOTHING;
    integral.n_steps = from < to ? core_n_steps((to - from) * per_parameter) : 0u;
    integral.n_samples = integral.n_breakpoints = 0u;
    integral.last = core_optics(elvis_real(0), elvis_real(0), elvis_real(0), elvis_real(0));
    return integral;
}

elvis_real core_integral_at(core_integral integral) {
    const elvis_real share = elvis_real(integral.n_samples) / elvis_real(max(integral.n_steps, 1u));
    return integral.n_samples == integral.n_steps ? integral.to : integral.from + (integral.to - integral.from) * share;
}

void core_integral_add(inout core_integral integral, inout core_light light, core_ray_sample found, core_accuracy wanted,
                       inout core_held_piece held, inout uint work) {
    const core_optics optics = core_optics_at(found.value);
    const elvis_real length = (integral.to - integral.from) * wanted.per_parameter, width = length / elvis_real(integral.n_steps);
    const bool is_first = integral.n_samples == 0u;
#if CORE_INTEGRATOR == CORE_INTEGRATOR_RIEMANN
    core_add_light(light, width * core_light_of(optics), elvis_exp(-width * optics.density));
    const uint n_wanted = integral.n_steps;
#else
    // From the last sample to this one.
    const elvis_real half_width = is_first ? elvis_real(0) : elvis_real(0.5LF) * width;
    const elvis_real transmittance = elvis_exp(-half_width * (integral.last.density + optics.density));
    core_add_light(light, half_width * (core_light_of(integral.last) + transmittance * core_light_of(optics)), transmittance);
    const uint n_wanted = integral.n_steps + 1u;
#endif
    light.error += is_first && core_has_too_few_steps(length) ? elvis_real(1) : elvis_real(0);
    integral.last = optics;
    integral.n_samples += 1u;
    integral.wants = integral.n_samples < n_wanted ? CORE_WANTS_VALUE : CORE_WANTS_NOTHING;
}
