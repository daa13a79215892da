// The volume rendering integral along a ray's part in one element by steps of equal length, no longer than core_step: as it is done
// where the breakpoints of the transfer function are not known (B. Nelson, 2012, chapter 6). CORE_INTEGRATOR as elvis::Integrator.
//
// The kernel brings library/volume_light.glsl.

#define CORE_WANTS_NOTHING 0u
#define CORE_WANTS_VALUE 1u

#define CORE_INTEGRATOR_RIEMANN 0
#define CORE_INTEGRATOR_TRAPEZOID 1

struct core_integral {
    elvis_real from, to;
    // Up to here light is settled.
    elvis_real left;
    uint wants;
    // Steps; samples taken.
    uint n_steps, n_samples;
    // At the last sample: density, and light per length.
    elvis_real density, red, green, blue;
    uint n_breakpoints;
};

core_integral core_integral_begin(elvis_real from, elvis_real to, elvis_real per_parameter, elvis_real step) {
    core_integral integral;
    integral.from = integral.left = from;
    integral.to = to;
    integral.wants = from < to ? CORE_WANTS_VALUE : CORE_WANTS_NOTHING;
    integral.n_steps = from < to ? max(uint(min(ceil((to - from) * per_parameter / elvis_real(core_step)), elvis_real(16384))), 1u) : 0u;
    integral.n_samples = integral.n_breakpoints = 0u;
    integral.density = integral.red = integral.green = integral.blue = elvis_real(0);
    return integral;
}

elvis_real core_integral_at(core_integral integral) {
    return integral.from + (integral.to - integral.from) * elvis_real(integral.n_samples) / elvis_real(max(integral.n_steps, 1u));
}

elvis_real core_integral_span(core_integral integral) { return elvis_real(0); }

void core_integral_add(inout core_integral integral, inout core_light light, elvis_real value, elvis_real slope, elvis_real error,
                       elvis_real bend, elvis_real per_parameter, elvis_real tolerance, elvis_real ahead, inout uint work) {
    const core_transfer_piece piece = core_fetch_piece(core_piece_index(value));
    const elvis_real density = core_density_at(piece, value);
    const elvis_vec3 color = density * core_color_at(piece, value);
    const elvis_real width = (integral.to - integral.from) * per_parameter / elvis_real(integral.n_steps);
#if CORE_INTEGRATOR == CORE_INTEGRATOR_RIEMANN
    core_add_light(light, width * color, elvis_exp(-width * density));
    const uint n_wanted = integral.n_steps;
#else
    // From the last sample to this one.
    const bool is_step = integral.n_samples > 0u;
    const elvis_real half_width = is_step ? elvis_real(0.5LF) * width : elvis_real(0);
    const elvis_real through = elvis_exp(-half_width * (integral.density + density));
    const elvis_vec3 last = elvis_vec3(integral.red, integral.green, integral.blue);
    core_add_light(light, half_width * (last + through * color), through);
    const uint n_wanted = integral.n_steps + 1u;
#endif
    integral.density = density;
    integral.red = color.x;
    integral.green = color.y;
    integral.blue = color.z;
    integral.n_samples += 1u;
    integral.wants = integral.n_samples < n_wanted ? CORE_WANTS_VALUE : CORE_WANTS_NOTHING;
}
