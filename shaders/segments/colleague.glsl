// Roots as eigenvalues: the reference method, which nothing but comparison uses. The roots of the Chebyshev series
// c_0 T_0 + .. + c_n T_n are the eigenvalues of its colleague matrix (Good 1961; Trefethen, Approximation Theory and Approximation
// Practice, chapter 18), the companion matrix of that basis. Nelson & Kirby 2006 do the same after turning a Legendre series into
// powers or Bernstein polynomials; the Chebyshev basis needs no such change of basis, which would lose digits.
//
// The transposed matrix is of upper Hessenberg form: balanced by powers of two, then reduced by the implicit double-shift QR algorithm
// (EISPACK's balanc and hqr; Golub & Van Loan, section 7.5). Its elements are indexed by loops, which spills them: slow, and known to be.

#ifndef CORE_FIT_COLLEAGUE
#define CORE_FIT_COLLEAGUE

#include "segments/bernstein.glsl"

// For one eigenvalue, every tenth with exceptional shifts. EISPACK's limit of 30 left one in 15,000 polynomials unsolved.
#define CORE_COLLEAGUE_SWEEPS 90u
// What counts as zero beside others: their last place.
#define CORE_COLLEAGUE_PRECISION (elvis_real(2) * CORE_ROUNDOFF)

struct core_colleague_root {
    // The first real root in [0, 1]; 2 if there is none.
    elvis_real t;
    // An eigenvalue did not converge.
    bool has_failed;
};

elvis_real core_colleague_matrix[CORE_FIT_DEGREE * CORE_FIT_DEGREE];
#define CORE_H(row, column) core_colleague_matrix[(row) * CORE_FIT_DEGREE + (column)]

// Of the series p - value, of which no more is known than within `error`; the number of rows, less where leading coefficients are
// rounding or too small to be known: divided by such a one, the others would be so large that rounding moves roots anywhere.
int core_colleague_fill(core_polynomial chebyshev, elvis_real value, elvis_real error) {
    const elvis_real half_ = elvis_real(0.5LF);
    chebyshev.c[0] -= value;
    elvis_real largest = elvis_real(0);
    for (int k = 0; k < CORE_FIT_SIZE; ++k) {
        largest = max(largest, abs(chebyshev.c[k]));
    }
    const elvis_real least = max(CORE_ROUNDOFF * largest, error / elvis_real(CORE_FIT_SIZE));
    int n = CORE_FIT_DEGREE;
    while (n > 0 && abs(chebyshev.c[n]) <= least) {
        n -= 1;
    }
    for (int row = 0; row < n; ++row) {
        for (int column = 0; column < n; ++column) {
            CORE_H(row, column) = row == column + 1 ? (column == 0 ? elvis_real(1) : half_) : row + 1 == column ? half_ : elvis_real(0);
        }
    }
    const elvis_real scale = n == 1 ? elvis_real(1) : half_;
    for (int row = 0; row < n; ++row) {
        CORE_H(row, n - 1) -= scale * chebyshev.c[row] / chebyshev.c[n];
    }
    return n;
}

// Rows and columns scaled by powers of two until both have about the same size: eigenvalues stay, rounding errors shrink.
void core_colleague_balance(int n) {
    bool is_done = false;
    for (uint iteration = 0u; iteration < 16u && !is_done; ++iteration) {
        is_done = true;
        for (int i = 0; i < n; ++i) {
            elvis_real row = elvis_real(0), column = elvis_real(0);
            for (int j = 0; j < n; ++j) {
                row += j == i ? elvis_real(0) : abs(CORE_H(i, j));
                column += j == i ? elvis_real(0) : abs(CORE_H(j, i));
            }
            elvis_real factor = elvis_real(1), c = column;
            while (row > elvis_real(0) && c > elvis_real(0) && c < elvis_real(0.5LF) * row) {
                factor *= elvis_real(2);
                c *= elvis_real(4);
            }
            while (row > elvis_real(0) && c > elvis_real(0) && c >= elvis_real(2) * row) {
                factor *= elvis_real(0.5LF);
                c *= elvis_real(0.25LF);
            }
            const bool is_better = (c + row) / factor < elvis_real(0.95LF) * (column + row);
            for (int j = 0; j < (is_better ? n : 0); ++j) {
                CORE_H(i, j) /= factor;
            }
            for (int j = 0; j < (is_better ? n : 0); ++j) {
                CORE_H(j, i) *= factor;
            }
            is_done = is_done && !is_better;
        }
    }
}

// The first reflection of a sweep: its row, and the vector that it maps to a multiple of the first unit vector.
struct core_colleague_bulge {
    int start;
    elvis_real p, q, r;
};

// Where two subdiagonal elements in a row are small the sweep may start.
core_colleague_bulge core_colleague_start(int low, int high, elvis_real x, elvis_real y, elvis_real w) {
    core_colleague_bulge bulge;
    bulge.start = high - 2;
    bool goes_on = true;
    while (goes_on) {
        const int start = bulge.start, before = max(start - 1, 0);
        const elvis_real z = CORE_H(start, start), a = x - z, b = y - z;
        const elvis_real p = (a * b - w) / CORE_H(start + 1, start) + CORE_H(start, start + 1);
        const elvis_real q = CORE_H(start + 1, start + 1) - z - a - b, r = CORE_H(start + 2, start + 1);
        const elvis_real size = abs(p) + abs(q) + abs(r);
        bulge.p = p / size;
        bulge.q = q / size;
        bulge.r = r / size;
        const elvis_real beside = abs(CORE_H(start, before)) * (abs(bulge.q) + abs(bulge.r));
        const elvis_real diagonal = abs(bulge.p) * (abs(CORE_H(before, before)) + abs(z) + abs(CORE_H(start + 1, start + 1)));
        goes_on = start > low && beside > CORE_COLLEAGUE_PRECISION * diagonal;
        bulge.start -= goes_on ? 1 : 0;
    }
    return bulge;
}

// Householder's reflection of rows and columns k, k + 1 and, unless it is beyond `high`, k + 2. `s`: the multiple.
void core_colleague_reflect(int low, int high, int k, elvis_real p, elvis_real q, elvis_real r, elvis_real s) {
    const bool has_third = k < high - 1;
    const int third = has_third ? k + 2 : k + 1;
    p += s;
    const elvis_real u = p / s, v = q / s, z = r / s;
    q /= p;
    r /= p;
    for (int j = k; j <= high; ++j) {
        const elvis_real sum = CORE_H(k, j) + q * CORE_H(k + 1, j) + (has_third ? r * CORE_H(third, j) : elvis_real(0));
        CORE_H(third, j) -= has_third ? sum * z : elvis_real(0);
        CORE_H(k + 1, j) -= sum * v;
        CORE_H(k, j) -= sum * u;
    }
    for (int i = low; i <= min(high, k + 3); ++i) {
        const elvis_real sum = u * CORE_H(i, k) + v * CORE_H(i, k + 1) + (has_third ? z * CORE_H(i, third) : elvis_real(0));
        CORE_H(i, third) -= has_third ? sum * r : elvis_real(0);
        CORE_H(i, k + 1) -= sum * q;
        CORE_H(i, k) -= sum;
    }
}

// One implicit double-shift sweep over rows low .. high, with shifts of sum `x + y` and product `x y - w`: reflections chase the bulge
// down.
void core_colleague_sweep(int low, int high, elvis_real x, elvis_real y, elvis_real w) {
    core_colleague_bulge bulge = core_colleague_start(low, high, x, y, w);
    const int start = bulge.start;
    for (int i = start + 2; i <= high; ++i) {
        CORE_H(i, i - 2) = elvis_real(0);
        if (i > start + 2) {
            CORE_H(i, i - 3) = elvis_real(0);
        }
    }
    for (int k = start; k < high; ++k) {
        elvis_real size = elvis_real(1);
        if (k > start) {
            const elvis_real p = CORE_H(k, k - 1), q = CORE_H(k + 1, k - 1), r = k < high - 1 ? CORE_H(k + 2, k - 1) : elvis_real(0);
            size = abs(p) + abs(q) + abs(r);
            const elvis_real divisor = size > elvis_real(0) ? size : elvis_real(1);
            bulge.p = p / divisor;
            bulge.q = q / divisor;
            bulge.r = r / divisor;
        }
        const elvis_real norm = sqrt(bulge.p * bulge.p + bulge.q * bulge.q + bulge.r * bulge.r);
        const elvis_real s = bulge.p < elvis_real(0) ? -norm : norm;
        if (s != elvis_real(0)) {
            if (k > start) {
                CORE_H(k, k - 1) = -s * size;
            } else if (start > low) {
                CORE_H(k, k - 1) = -CORE_H(k, k - 1);
            }
            core_colleague_reflect(low, high, k, bulge.p, bulge.q, bulge.r, s);
        }
    }
}

// A real eigenvalue x is a root at t = (1 + x) / 2; beyond the ends by what rounding moves it, it is one at the end.
elvis_real core_colleague_earlier(elvis_real t, elvis_real x) {
    const elvis_real candidate = elvis_real(0.5LF) * (elvis_real(1) + x);
    const elvis_real slack = elvis_real(16 * CORE_FIT_DEGREE) * CORE_ROUNDOFF;
    const bool is_within = candidate >= -slack && candidate <= elvis_real(1) + slack;
    return is_within ? min(t, clamp(candidate, elvis_real(0), elvis_real(1))) : t;
}

core_colleague_root core_first_root_by_colleague(core_polynomial chebyshev, elvis_real value, elvis_real error) {
    core_colleague_root root = core_colleague_root(elvis_real(2), false);
    const int n = core_colleague_fill(chebyshev, value, error);
    core_colleague_balance(n);
    elvis_real norm = elvis_real(0);
    for (int i = 0; i < n; ++i) {
        for (int j = max(i - 1, 0); j < n; ++j) {
            norm += abs(CORE_H(i, j));
        }
    }
    // Eigenvalues are split off at the lower right; `shift` is what exceptional shifts have taken from the diagonal.
    int high = n - 1;
    uint sweeps = 0u;
    elvis_real shift = elvis_real(0);
    while (high >= 0 && !root.has_failed) {
        int low = high;
        bool goes_on = low > 0;
        while (goes_on) {
            const elvis_real beside = abs(CORE_H(low - 1, low - 1)) + abs(CORE_H(low, low));
            const bool is_split = abs(CORE_H(low, low - 1)) <= CORE_COLLEAGUE_PRECISION * (beside == elvis_real(0) ? norm : beside);
            low -= is_split ? 0 : 1;
            goes_on = !is_split && low > 0;
        }
        const int above = max(high - 1, 0);
        elvis_real x = CORE_H(high, high), y = CORE_H(above, above), w = CORE_H(high, above) * CORE_H(above, high);
        if (low == high) {
            root.t = core_colleague_earlier(root.t, x + shift);
            high -= 1;
            sweeps = 0u;
        } else if (low == high - 1) {
            // Two at once: real if the discriminant is not negative.
            const elvis_real p = elvis_real(0.5LF) * (y - x), q = p * p + w, z = sqrt(abs(q));
            const elvis_real far = p + (p < elvis_real(0) ? -z : z);
            const elvis_real near = far != elvis_real(0) ? x - w / far : x + far;
            const elvis_real first = core_colleague_earlier(root.t, x + shift + far);
            root.t = q >= elvis_real(0) ? core_colleague_earlier(first, near + shift) : root.t;
            high -= 2;
            sweeps = 0u;
        } else {
            root.has_failed = sweeps == CORE_COLLEAGUE_SWEEPS;
            if (sweeps % 10u == 9u) {
                shift += x;
                for (int i = 0; i <= high; ++i) {
                    CORE_H(i, i) -= x;
                }
                const elvis_real s = abs(CORE_H(high, high - 1)) + abs(CORE_H(high - 1, high - 2));
                x = y = elvis_real(0.75LF) * s;
                w = elvis_real(-0.4375LF) * s * s;
            }
            sweeps += 1u;
            core_colleague_sweep(low, high, x, y, w);
        }
    }
    return root;
}

#undef CORE_H

#endif
