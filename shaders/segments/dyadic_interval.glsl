// The pieces into which a part of a ray is halved, from its beginning to its end, with samples of the field and of its slope; samples
// at common ends are taken once.
//
// Needs: CORE_MOST_LEVELS, times that a part may be halved.

// The samples of a piece, and what comes after it: samples at the ends of the pieces that it is in, by level.
struct core_piece {
    core_segment values, slopes;
    elvis_real end_values[CORE_MOST_LEVELS + 1u], end_slopes[CORE_MOST_LEVELS + 1u];
    // [index, index + 1] / 2^level of the part.
    uint level, index;
};

// To the first half of a piece.
void core_halve(inout core_piece piece) {
    piece.end_values[piece.level] = piece.values.samples[1];
    piece.end_slopes[piece.level] = piece.slopes.samples[1];
    piece.level += 1u;
    piece.index *= 2u;
    piece.end_values[piece.level] = piece.values.samples[2];
    piece.end_slopes[piece.level] = piece.slopes.samples[2];
    piece.values = core_segment_half(piece.values, 0u);
    piece.slopes = core_segment_half(piece.slopes, 0u);
}

// To the piece after it in the same part.
void core_next_piece(inout core_piece piece) {
    const uint next = piece.index + 1u;
    const uint up = uint(findLSB(next));
    piece.index = next >> up;
    piece.level -= up;
    const elvis_real value = piece.values.samples[1], slope = piece.slopes.samples[1], error = piece.values.sample_error;
    piece.values = piece.slopes = core_segment_begin();
    piece.values.samples[0] = value;
    piece.slopes.samples[0] = slope;
    piece.end_values[piece.level] = piece.values.samples[1] = piece.end_values[piece.level - 1u];
    piece.end_slopes[piece.level] = piece.slopes.samples[1] = piece.end_slopes[piece.level - 1u];
    piece.values.n_samples = piece.slopes.n_samples = 2u;
    piece.values.sample_error = error;
}

bool core_is_last_piece(core_piece piece) { return piece.index + 1u == 1u << piece.level; }

void core_add_sample(inout core_piece piece, core_ray_sample found) {
    for (int i = 0; i < CORE_SEGMENT_SAMPLES; ++i) {
        piece.slopes.samples[i] = uint(i) == piece.slopes.n_samples ? found.slope : piece.slopes.samples[i];
    }
    piece.slopes.n_samples += 1u;
    core_segment_add(piece.values, found.value, found.error, elvis_real(-1));
}

// What the samples' slopes say about the error of a polynomial on a piece of this length: between nodes at distances h the difference
// from the field is like A sin(pi t / h), which has the slope pi A / h at the nodes; h is about pi sqrt(t (1 - t)) / n, and 1 / n^2 at
// the ends.
elvis_real core_slope_error(core_piece piece, core_polynomial bernstein, elvis_real size) {
    const elvis_real degree = elvis_real(CORE_SEGMENT_DEGREE), inverse = elvis_real(1) / elvis_real(piece.slopes.n_samples - 1u);
    elvis_real error = elvis_real(0);
    for (int i = 0; i < CORE_SEGMENT_SAMPLES; ++i) {
        const elvis_real t = core_segment_parameters[i], s = elvis_real(1) - t;
        // Of the derivative's Bernstein form, as in core_bernstein_value: its coefficients are degree * differences.
        elvis_real power = elvis_real(1), sum = elvis_real(0);
        for (int k = 0; k < CORE_SEGMENT_DEGREE; ++k) {
            const elvis_real binomial = core_segment_binomials[k] * (degree - elvis_real(k)) / degree;
            sum = sum * s + binomial * power * (bernstein.c[k + 1] - bernstein.c[k]);
            power *= t;
        }
        const elvis_real off = abs(degree * sum - size * piece.slopes.samples[i]) * (sqrt(t * s) + inverse) * inverse;
        error = uint(i) < piece.slopes.n_samples ? max(error, off) : error;
    }
    return error;
}
