// Samples to polynomial. Each iteration of a kernel's loop takes one sample:
//
//     core_fit_samples segment = core_fit_begin();
//     (while more samples are wanted)
//         core_fit_add(segment, (the field at core_fit_parameter(segment)), sample_error);
//         if (core_fit_is_decision(segment)) {
//             fit = core_fit_of(segment), and is its error small enough?
//         }
//
// The degree is raised (2, 4, 8) until the caller finds the error estimate small enough; each degree uses all samples of the one before.
// If the highest is not enough (core_fit_is_full), the caller halves the segment: core_fit_half hands on the samples at ends and middle.
// Tables for one fixed degree leave one decision. core_fit_of is long: a kernel calls it at one place only.
//
// Error estimate: E = misfit + tail + rounding.
//   misfit    The interpolant p_n is compared with the field at two points between the nodes. This bounds the difference from the
//             polynomial of degree n + 2 through these as well.
//   tail      What comes after that, if terms go on to decay as they do: a geometric series with the ratio of this difference to
//             the last two coefficients of p_n, two degrees before. A ratio below 1/4 is not believed, as two points do not see all;
//             one above 3/4 is no decay, and the difference itself says how large the error is, not how it goes on.
//   rounding  Of the samples, times the Lebesgue constant of the nodes, and of the arithmetic (core_bernstein_rounding).
// It is an estimate: a field may do anything between samples. It is tested on families of analytic functions
// (tests/segment/fit_test.cpp).

#ifndef CORE_FIT_FIT
#define CORE_FIT_FIT

#include "arithmetic/finite.glsl"
#include "segments/bernstein.glsl"

#define CORE_FIT_FASTEST_DECAY elvis_real(0.25LF)
#define CORE_FIT_SLOWEST_DECAY elvis_real(0.75LF)

// Of Chebyshev-Lobatto nodes at most 1 + 2 / pi log(n + 1) (Trefethen, theorem 15.2), which is 2.7 for degree 13.
#define CORE_FIT_LEBESGUE elvis_real(2.75LF)

struct core_fit_samples {
    elvis_real samples[CORE_FIT_SAMPLES];
    uint n_samples;
    // No sample was NaN or infinite.
    bool is_finite;
    // Largest absolute error of a sample.
    elvis_real sample_error;
};

struct core_fit {
    // In the Chebyshev basis, T_k(2 t - 1).
    core_polynomial chebyshev;
    // Between field and polynomial, arithmetic on its Bernstein form included.
    elvis_real error;
    uint degree;
};

core_fit_samples core_fit_begin() {
    core_fit_samples sampled;
    for (int i = 0; i < CORE_FIT_SAMPLES; ++i) {
        sampled.samples[i] = elvis_real(0);
    }
    sampled.n_samples = 0u;
    sampled.is_finite = true;
    sampled.sample_error = elvis_real(0);
    return sampled;
}

// One half (0 or 1) of a segment whose first three samples are at 0, 1 and 1/2, as those of even degrees are.
core_fit_samples core_fit_half(core_fit_samples whole, uint half_) {
    core_fit_samples sampled = core_fit_begin();
    sampled.samples[0] = half_ == 0u ? whole.samples[0] : whole.samples[2];
    sampled.samples[1] = half_ == 0u ? whole.samples[2] : whole.samples[1];
    sampled.n_samples = 2u;
    sampled.sample_error = whole.sample_error;
    return sampled;
}

// Where the next sample is wanted.
elvis_real core_fit_parameter(core_fit_samples sampled) {
    elvis_real t = elvis_real(0);
    for (int i = 0; i < CORE_FIT_SAMPLES; ++i) {
        t = uint(i) == sampled.n_samples ? core_fit_parameters[i] : t;
    }
    return t;
}

// The highest degree that the samples allow to judge.
core_fit core_fit_of(core_fit_samples sampled) {
    core_fit fit;
    elvis_real error = elvis_real(0);
    fit.degree = 0u;
    fit.chebyshev = core_polynomial_zero();
    for (int level = 0; level < CORE_FIT_LEVELS; ++level) {
        const bool is_judged = sampled.n_samples >= core_fit_counts[level];
        const uint degree = core_fit_degrees[level];
        elvis_real last = elvis_real(0);
        for (int k = 0; k < CORE_FIT_SIZE; ++k) {
            elvis_real sum = elvis_real(0);
            for (int i = 0; i < CORE_FIT_SAMPLES; ++i) {
                sum += core_fit_fits[level][k][i] * sampled.samples[i];
            }
            fit.chebyshev.c[k] = is_judged ? sum : fit.chebyshev.c[k];
            last += uint(k) == degree || uint(k) + 1u == degree ? abs(sum) : elvis_real(0);
        }
        elvis_real misfit = elvis_real(0);
        for (int check = 0; check < CORE_FIT_CHECKS; ++check) {
            elvis_real sum = elvis_real(0);
            for (int i = 0; i < CORE_FIT_SAMPLES; ++i) {
                sum += core_fit_misfits[level][check][i] * sampled.samples[i];
            }
            misfit += abs(sum);
        }
        const elvis_real ratio = clamp(misfit < last ? misfit / last : elvis_real(1), CORE_FIT_FASTEST_DECAY, CORE_FIT_SLOWEST_DECAY);
        error = is_judged ? misfit / (elvis_real(1) - ratio) : error;
        fit.degree = is_judged ? degree : fit.degree;
    }
    fit.error = error + CORE_FIT_LEBESGUE * sampled.sample_error + core_bernstein_rounding(fit.chebyshev);
    return fit;
}

// `value` at core_fit_parameter(segment), with an absolute error of `sample_error` at most.
void core_fit_add(inout core_fit_samples sampled, elvis_real value, elvis_real sample_error) {
    for (int i = 0; i < CORE_FIT_SAMPLES; ++i) {
        sampled.samples[i] = uint(i) == sampled.n_samples ? value : sampled.samples[i];
    }
    sampled.n_samples += 1u;
    sampled.sample_error = max(sampled.sample_error, sample_error);
    sampled.is_finite = sampled.is_finite && core_is_finite(value);
}

// There are as many samples as the highest degree needs.
bool core_fit_is_full(core_fit_samples sampled) { return sampled.n_samples == uint(CORE_FIT_SAMPLES); }

// There are as many samples as one of the degrees needs, or no more are of use.
bool core_fit_is_decision(core_fit_samples sampled) {
    bool is_decision = !sampled.is_finite;
    for (int level = 0; level < CORE_FIT_LEVELS; ++level) {
        is_decision = is_decision || sampled.n_samples == core_fit_counts[level];
    }
    return is_decision;
}

#endif
