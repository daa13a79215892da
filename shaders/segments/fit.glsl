// Samples to polynomial. Each turn of a kernel's loop takes one sample:
//
//     core_segment segment = core_segment_begin();
//     while (segment.status == CORE_SEGMENT_WANTS) {
//         const elvis_real value = (the field at core_segment_parameter(segment));
//         core_segment_add(segment, value, sample_error, tolerance);
//     }
//     const core_fit fit = core_segment_fit(segment);
//
// The degree is raised (2, 4, 8) until the error estimate is below the tolerance; each degree uses all samples of the one before.
// If the highest is not enough, the caller halves the segment: core_segment_half hands on the samples at ends and middle. Tables
// for one fixed degree leave one decision, done or split.
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

#ifndef CORE_SEGMENT_FIT
#define CORE_SEGMENT_FIT

#include "arithmetic/finite.glsl"
#include "segments/bernstein.glsl"

#define CORE_SEGMENT_WANTS 0u
#define CORE_SEGMENT_DONE 1u
// Not good enough: halve the segment, or go on with the fit and its error.
#define CORE_SEGMENT_SPLIT 2u
// A sample was NaN or infinite.
#define CORE_SEGMENT_NOT_FINITE 3u

#define CORE_SEGMENT_FASTEST_DECAY elvis_real(0.25LF)
#define CORE_SEGMENT_SLOWEST_DECAY elvis_real(0.75LF)

// Of Chebyshev-Lobatto nodes at most 1 + 2 / pi log(n + 1) (Trefethen, theorem 15.2), which is 2.7 for degree 13.
#define CORE_SEGMENT_LEBESGUE elvis_real(2.75LF)

struct core_segment {
    elvis_real samples[CORE_SEGMENT_SAMPLES];
    uint n_samples;
    uint status;
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

core_segment core_segment_begin() {
    core_segment segment;
    for (int i = 0; i < CORE_SEGMENT_SAMPLES; ++i) {
        segment.samples[i] = elvis_real(0);
    }
    segment.n_samples = 0u;
    segment.status = CORE_SEGMENT_WANTS;
    segment.sample_error = elvis_real(0);
    return segment;
}

// One half (0 or 1) of a segment whose first three samples are at 0, 1 and 1/2, as those of even degrees are.
core_segment core_segment_half(core_segment whole, uint half_) {
    core_segment segment = core_segment_begin();
    segment.samples[0] = half_ == 0u ? whole.samples[0] : whole.samples[2];
    segment.samples[1] = half_ == 0u ? whole.samples[2] : whole.samples[1];
    segment.n_samples = 2u;
    segment.sample_error = whole.sample_error;
    return segment;
}

// Where the next sample is wanted.
elvis_real core_segment_parameter(core_segment segment) {
    elvis_real t = elvis_real(0);
    for (int i = 0; i < CORE_SEGMENT_SAMPLES; ++i) {
        t = uint(i) == segment.n_samples ? core_segment_parameters[i] : t;
    }
    return t;
}

// The highest degree that the samples allow to judge.
core_fit core_segment_fit(core_segment segment) {
    core_fit fit;
    elvis_real error = elvis_real(0);
    fit.degree = 0u;
    for (int k = 0; k < CORE_SEGMENT_SIZE; ++k) {
        fit.chebyshev.c[k] = elvis_real(0);
    }
    for (int level = 0; level < CORE_SEGMENT_LEVELS; ++level) {
        const bool is_judged = segment.n_samples >= core_segment_counts[level];
        const uint degree = core_segment_degrees[level];
        elvis_real last = elvis_real(0);
        for (int k = 0; k < CORE_SEGMENT_SIZE; ++k) {
            elvis_real sum = elvis_real(0);
            for (int i = 0; i < CORE_SEGMENT_SAMPLES; ++i) {
                sum += core_segment_fits[level][k][i] * segment.samples[i];
            }
            fit.chebyshev.c[k] = is_judged ? sum : fit.chebyshev.c[k];
            last += uint(k) == degree || uint(k) + 1u == degree ? abs(sum) : elvis_real(0);
        }
        elvis_real misfit = elvis_real(0);
        for (int check = 0; check < CORE_SEGMENT_CHECKS; ++check) {
            elvis_real sum = elvis_real(0);
            for (int i = 0; i < CORE_SEGMENT_SAMPLES; ++i) {
                sum += core_segment_misfits[level][check][i] * segment.samples[i];
            }
            misfit += abs(sum);
        }
        const elvis_real ratio = clamp(misfit < last ? misfit / last : elvis_real(1), CORE_SEGMENT_FASTEST_DECAY, CORE_SEGMENT_SLOWEST_DECAY);
        error = is_judged ? misfit / (elvis_real(1) - ratio) : error;
        fit.degree = is_judged ? degree : fit.degree;
    }
    fit.error = error + CORE_SEGMENT_LEBESGUE * segment.sample_error + core_bernstein_rounding(fit.chebyshev);
    return fit;
}

// `value` at core_segment_parameter(segment), with an absolute error of `sample_error` at most.
void core_segment_add(inout core_segment segment, elvis_real value, elvis_real sample_error, elvis_real tolerance) {
    for (int i = 0; i < CORE_SEGMENT_SAMPLES; ++i) {
        segment.samples[i] = uint(i) == segment.n_samples ? value : segment.samples[i];
    }
    segment.n_samples += 1u;
    segment.sample_error = max(segment.sample_error, sample_error);
    bool is_decision = false;
    for (int level = 0; level < CORE_SEGMENT_LEVELS; ++level) {
        is_decision = is_decision || segment.n_samples == core_segment_counts[level];
    }
    bool is_good = false;
    if (is_decision) {
        is_good = core_segment_fit(segment).error <= tolerance;
    }
    const bool is_full = segment.n_samples == uint(CORE_SEGMENT_SAMPLES);
    segment.status = !core_is_finite(value) ? CORE_SEGMENT_NOT_FINITE
                     : is_good              ? CORE_SEGMENT_DONE
                     : is_full              ? CORE_SEGMENT_SPLIT
                                            : CORE_SEGMENT_WANTS;
}

#endif
