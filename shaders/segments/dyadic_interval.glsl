// The intervals into which a segment is halved, from its beginning to its end, with samples of the field and of its slope; samples
// at common ends are taken once.
//
// Needs: CORE_MOST_LEVELS, times that a segment may be halved.

// The samples of an interval, and what comes after it: samples at the ends of the intervals that it is in, by level.
struct core_dyadic_interval {
    core_fit_samples values, slopes;
    elvis_real end_values[CORE_MOST_LEVELS + 1u], end_slopes[CORE_MOST_LEVELS + 1u];
    // [index, index + 1] / 2^level of the segment.
    uint level, index;
};

// To the first half of an interval.
void core_halve(inout core_dyadic_interval interval) {
    interval.end_values[interval.level] = interval.values.samples[1];
    interval.end_slopes[interval.level] = interval.slopes.samples[1];
    interval.level += 1u;
    interval.index *= 2u;
    interval.end_values[interval.level] = interval.values.samples[2];
    interval.end_slopes[interval.level] = interval.slopes.samples[2];
    interval.values = core_fit_half(interval.values, 0u);
    interval.slopes = core_fit_half(interval.slopes, 0u);
}

// To the interval after it in the same segment.
void core_next_interval(inout core_dyadic_interval interval) {
    const uint next = interval.index + 1u;
    const uint up = uint(findLSB(next));
    interval.index = next >> up;
    interval.level -= up;
    const elvis_real value = interval.values.samples[1], slope = interval.slopes.samples[1], error = interval.values.sample_error;
    interval.values = interval.slopes = core_fit_begin();
    interval.values.samples[0] = value;
    interval.slopes.samples[0] = slope;
    interval.end_values[interval.level] = interval.values.samples[1] = interval.end_values[interval.level - 1u];
    interval.end_slopes[interval.level] = interval.slopes.samples[1] = interval.end_slopes[interval.level - 1u];
    interval.values.n_samples = interval.slopes.n_samples = 2u;
    interval.values.sample_error = error;
}

bool core_is_last_interval(core_dyadic_interval interval) { return interval.index + 1u == 1u << interval.level; }

void core_add_sample(inout core_dyadic_interval interval, core_ray_sample found) {
    for (int i = 0; i < CORE_FIT_SAMPLES; ++i) {
        interval.slopes.samples[i] = uint(i) == interval.slopes.n_samples ? found.slope : interval.slopes.samples[i];
    }
    interval.slopes.n_samples += 1u;
    core_fit_add(interval.values, found.value, found.error);
}

// What the samples' slopes say about the error of a polynomial on an interval of this length: between nodes at distances h the difference
// from the field is like A sin(pi t / h), which has the slope pi A / h at the nodes; h is about pi sqrt(t (1 - t)) / n, and 1 / n^2 at
// the ends.
elvis_real core_slope_error(core_dyadic_interval interval, core_polynomial bernstein, elvis_real size) {
    const elvis_real degree = elvis_real(CORE_FIT_DEGREE), inverse = elvis_real(1) / elvis_real(interval.slopes.n_samples - 1u);
    elvis_real error = elvis_real(0);
    for (int i = 0; i < CORE_FIT_SAMPLES; ++i) {
        const elvis_real t = core_fit_parameters[i], s = elvis_real(1) - t;
        // Of the derivative's Bernstein form, as in core_bernstein_value: its coefficients are degree * differences.
        elvis_real power = elvis_real(1), sum = elvis_real(0);
        for (int k = 0; k < CORE_FIT_DEGREE; ++k) {
            const elvis_real binomial = core_fit_binomials[k] * (degree - elvis_real(k)) / degree;
            sum = sum * s + binomial * power * (bernstein.c[k + 1] - bernstein.c[k]);
            power *= t;
        }
        const elvis_real off = abs(degree * sum - size * interval.slopes.samples[i]) * (sqrt(t * s) + inverse) * inverse;
        error = uint(i) < interval.slopes.n_samples ? max(error, off) : error;
    }
    return error;
}
