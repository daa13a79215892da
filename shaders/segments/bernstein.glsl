// The Bernstein form: p(t) = sum over i of b_i (n over i) t^i (1 - t)^(n-i). On [0, 1] it lies between the smallest and the largest
// b_i, starts at b_0 and ends at b_n; it has at most as many roots within as the b_i change sign, and as many or fewer by an even
// number (Farouki 2012, The Bernstein polynomial basis: a centennial retrospective).

#ifndef CORE_FIT_BERNSTEIN
#define CORE_FIT_BERNSTEIN

#include "arithmetic/precision.glsl"

#define CORE_FIT_SIZE (CORE_FIT_DEGREE + 1)

// Coefficients, in the Chebyshev or in the Bernstein basis.
struct core_polynomial {
    elvis_real c[CORE_FIT_SIZE];
};

core_polynomial core_polynomial_zero() {
    core_polynomial p;
    for (int k = 0; k < CORE_FIT_SIZE; ++k) {
        p.c[k] = elvis_real(0);
    }
    return p;
}

core_polynomial core_to_bernstein(core_polynomial chebyshev) {
    core_polynomial p;
    for (int j = 0; j < CORE_FIT_SIZE; ++j) {
        elvis_real sum = elvis_real(0);
        for (int k = 0; k < CORE_FIT_SIZE; ++k) {
            sum += core_fit_bernstein[j][k] * chebyshev.c[k];
        }
        p.c[j] = sum;
    }
    return p;
}

// What rounding can change in values and coefficients of a polynomial in its Bernstein form, restricted to any interval of the segment.
// The sum over k of n + 1 products loses n + 2 roundings of the largest |product| each (Higham 2002, section 3.1); n steps of de
// Casteljau, done twice, lose 3 of the largest coefficient each: they are convex combinations.
elvis_real core_bernstein_rounding(core_polynomial chebyshev) {
    elvis_real sum = elvis_real(0);
    for (int k = 0; k < CORE_FIT_SIZE; ++k) {
        sum += core_fit_growth[k] * abs(chebyshev.c[k]);
    }
    return elvis_real(7 * CORE_FIT_DEGREE + 2) * CORE_ROUNDOFF * sum;
}

elvis_real core_least(core_polynomial p) {
    elvis_real least = p.c[0];
    for (int i = 0; i < CORE_FIT_SIZE; ++i) {
        least = min(least, p.c[i]);
    }
    return least;
}

elvis_real core_most(core_polynomial p) {
    elvis_real most = p.c[0];
    for (int i = 0; i < CORE_FIT_SIZE; ++i) {
        most = max(most, p.c[i]);
    }
    return most;
}

// Certain where the coefficients do not rise and fall: those of the derivative are n times their differences.
bool core_is_monotone(core_polynomial p) {
    bool falls = false, rises = false;
    for (int i = 0; i < CORE_FIT_SIZE; ++i) {
        const elvis_real left = p.c[max(i - 1, 0)];
        falls = falls || p.c[i] < left;
        rises = rises || p.c[i] > left;
    }
    return !(falls && rises);
}

// How often the coefficients of p - value change sign, zeros left out.
uint core_variations(core_polynomial p, elvis_real value) {
    uint n = 0u;
    bool was_below = false, was_above = false;
    for (int i = 0; i < CORE_FIT_SIZE; ++i) {
        const bool is_below = p.c[i] < value, is_above = p.c[i] > value;
        n += (was_below && is_above) || (was_above && is_below) ? 1u : 0u;
        was_below = is_below || (was_below && !is_above);
        was_above = is_above || (was_above && !is_below);
    }
    return n;
}

// De Casteljau's triangle has the coefficients on [0, t] along one side and those on [t, 1] along the other.
core_polynomial core_before(core_polynomial p, elvis_real t) {
    for (int stage = 1; stage < CORE_FIT_SIZE; ++stage) {
        core_polynomial next;
        for (int i = 0; i < CORE_FIT_SIZE; ++i) {
            const elvis_real left = p.c[max(i - 1, 0)];
            next.c[i] = i >= stage ? left + t * (p.c[i] - left) : p.c[i];
        }
        p = next;
    }
    return p;
}

core_polynomial core_after(core_polynomial p, elvis_real t) {
    for (int stage = 1; stage < CORE_FIT_SIZE; ++stage) {
        core_polynomial next;
        for (int i = 0; i < CORE_FIT_SIZE; ++i) {
            const elvis_real right = p.c[min(i + 1, CORE_FIT_DEGREE)];
            next.c[i] = i + stage < CORE_FIT_SIZE ? p.c[i] + t * (right - p.c[i]) : p.c[i];
        }
        p = next;
    }
    return p;
}

// On [index, index + 1] / 2^level, always from the whole segment: errors do not add up with the level.
core_polynomial core_restricted(core_polynomial p, uint level, uint index) {
    const elvis_real end = elvis_real(index + 1u);
    return core_after(core_before(p, end / elvis_real(1u << level)), elvis_real(index) / end);
}

// Horner's rule in t with (1 - t) carried along: no cancellation that the coefficients do not have.
elvis_real core_bernstein_value(core_polynomial p, elvis_real t) {
    const elvis_real s = elvis_real(1) - t;
    elvis_real power = elvis_real(1), sum = elvis_real(0);
    for (int i = 0; i < CORE_FIT_SIZE; ++i) {
        sum = sum * s + core_fit_binomials[i] * power * p.c[i];
        power *= t;
    }
    return sum;
}

#endif
