/**
 * @file polynomial.hpp
 * Polynomials on a segment, t in [0, 1], in the Chebyshev or the Bernstein basis: the CPU's twin of
 * shaders/segments/bernstein.glsl, in both precisions, for tests and for work on the host.
 */
#pragma once

#include <core/segment/tables.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace elvis::segment {

/** Half the distance from 1 to the next number. */
template <class Real> constexpr Real roundoff = std::numeric_limits<Real>::epsilon() / 2;

template <class Real> struct Polynomial {
    int degree = 0;
    std::array<Real, max_degree + 1> c{};

    Real& operator[](int i) { return c[static_cast<std::size_t>(i)]; }
    Real operator[](int i) const { return c[static_cast<std::size_t>(i)]; }
};

/** The tables of one degree, rounded once. */
template <class Real> struct BernsteinTables {
    int degree;
    std::vector<Real> matrix, growth, binomials;

    static const BernsteinTables& of(int degree) {
        static const std::vector<BernsteinTables> all = [] {
            std::vector<BernsteinTables> tables;
            for (int n = 0; n <= max_degree; ++n) {
                tables.push_back(
                    {n, rounded(bernstein_of_chebyshev(n)), rounded(bernstein_growth(n)), rounded(segment::binomials(n))});
            }
            return tables;
        }();
        return all[static_cast<std::size_t>(degree)];
    }

private:
    static std::vector<Real> rounded(const std::vector<double>& numbers) {
        std::vector<Real> result;
        for (const double number : numbers) {
            result.push_back(static_cast<Real>(number));
        }
        return result;
    }
};

template <class Real> Polynomial<Real> to_bernstein(const Polynomial<Real>& chebyshev) {
    const int n = chebyshev.degree;
    const std::vector<Real>& matrix = BernsteinTables<Real>::of(n).matrix;
    Polynomial<Real> p{n, {}};
    for (int j = 0; j <= n; ++j) {
        for (int k = 0; k <= n; ++k) {
            p[j] += matrix[static_cast<std::size_t>(j * (n + 1) + k)] * chebyshev[k];
        }
    }
    return p;
}

/** What rounding can change in values and coefficients of the Bernstein form, restricted to any part of the segment. */
template <class Real> Real bernstein_rounding(const Polynomial<Real>& chebyshev) {
    const std::vector<Real>& growth = BernsteinTables<Real>::of(chebyshev.degree).growth;
    Real sum = 0;
    for (int k = 0; k <= chebyshev.degree; ++k) {
        sum += growth[static_cast<std::size_t>(k)] * std::abs(chebyshev[k]);
    }
    return static_cast<Real>(7 * chebyshev.degree + 2) * roundoff<Real> * sum;
}

template <class Real> std::array<Real, 2> range(const Polynomial<Real>& p) {
    const auto [least, most] = std::minmax_element(p.c.begin(), p.c.begin() + p.degree + 1);
    return {*least, *most};
}

/** Whether the coefficients do not turn round. */
template <class Real> bool is_monotone(const Polynomial<Real>& p) {
    bool falls = false, rises = false;
    for (int i = 0; i < p.degree; ++i) {
        falls = falls || p[i + 1] < p[i];
        rises = rises || p[i + 1] > p[i];
    }
    return !(falls && rises);
}

/** How often the coefficients of p - value change sign, zeros left out. */
template <class Real> std::uint32_t variations(const Polynomial<Real>& p, Real value) {
    std::uint32_t n = 0;
    int last = 0;
    for (int i = 0; i <= p.degree; ++i) {
        const int sign = p[i] < value ? -1 : p[i] > value ? 1 : 0;
        n += sign * last < 0 ? 1 : 0;
        last = sign == 0 ? last : sign;
    }
    return n;
}

/** On [0, t]: one side of de Casteljau's triangle. */
template <class Real> Polynomial<Real> before(Polynomial<Real> p, Real t) {
    for (int stage = 1; stage <= p.degree; ++stage) {
        for (int i = p.degree; i >= stage; --i) {
            p[i] = p[i - 1] + t * (p[i] - p[i - 1]);
        }
    }
    return p;
}

/** On [t, 1]: the other side. */
template <class Real> Polynomial<Real> after(Polynomial<Real> p, Real t) {
    for (int stage = 1; stage <= p.degree; ++stage) {
        for (int i = 0; i + stage <= p.degree; ++i) {
            p[i] += t * (p[i + 1] - p[i]);
        }
    }
    return p;
}

/** On [place, place + 1] / 2^level. */
template <class Real> Polynomial<Real> restricted(const Polynomial<Real>& p, std::uint32_t level, std::uint32_t place) {
    const Real end = static_cast<Real>(place + 1);
    return after(before(p, end / static_cast<Real>(1u << level)), static_cast<Real>(place) / end);
}

template <class Real> Real bernstein_value(const Polynomial<Real>& p, Real t) {
    const std::vector<Real>& binomials = BernsteinTables<Real>::of(p.degree).binomials;
    const Real s = 1 - t;
    Real power = 1, sum = p[0];
    for (int i = 1; i <= p.degree; ++i) {
        power *= t;
        sum = sum * s + binomials[static_cast<std::size_t>(i)] * power * p[i];
    }
    return sum;
}

/** Clenshaw's rule, with x = 2 t - 1. */
template <class Real> Real chebyshev_value(const Polynomial<Real>& p, Real t) {
    const Real x = 2 * t - 1;
    Real next = 0, after_next = 0;
    for (int k = p.degree; k >= 1; --k) {
        const Real here = p[k] + 2 * x * next - after_next;
        after_next = next;
        next = here;
    }
    return p[0] + x * next - after_next;
}

} // namespace elvis::segment
