/*
 * Everything is computed in long double from formulas without cancellation:
 *
 *   P_n^{a,b}(z) = sum_k (-1)^(n-k) C(n+a, k) C(n+b, n-k) l^(n-k) r^k       (Szego, Orthogonal Polynomials, 4.3.2)
 *
 * and Lagrange polynomials as products of z - z_j = -(1+z_j) l + (1-z_j) r, whose coefficients have equal signs by power.
 * Multiplication by l and r shifts; elevation of the degree averages, so that it adds an error of a few units of the last place
 * of long double a degree, relative to the largest coefficient: below 2^-53 together for all degrees in use.
 */
#include "bernstein.hpp"

#include "../basis/quadrature.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace elvis::native {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "the error bounds of Bernstein coefficients need long double");

long double binomial(int n, int k) {
    long double result = 1;
    for (int i = 1; i <= k; ++i)
        result = result * static_cast<long double>(n - k + i) / static_cast<long double>(i);
    return result;
}

// Polynomials as coefficients of l^(degree-k) r^k at [k], without binomial factors.
using Homogeneous = std::vector<long double>;

Homogeneous jacobi_form(int n, int a, int b) {
    Homogeneous result;
    for (int k = 0; k <= n; ++k)
        result.push_back(((n - k) % 2 == 0 ? 1 : -1) * binomial(n + a, k) * binomial(n + b, n - k));
    return result;
}

void multiply_by_l(Homogeneous& f, int times) { f.insert(f.end(), static_cast<std::size_t>(times), 0.0L); }

void multiply_by_r(Homogeneous& f) { f.insert(f.begin(), 0.0L); }

void scale(Homogeneous& f, long double factor) {
    for (long double& value : f)
        value *= factor;
}

Homogeneous lagrange_form(Kind kind, std::uint32_t order, int index) {
    std::array<long double, max_order + 1> points{};
    const std::span<long double> used(points.data(), order + 1);
    if (kind == Kind::gll_lagrange)
        gauss_lobatto_legendre(used);
    else
        gauss_legendre(used);
    const auto i = static_cast<std::size_t>(index);
    Homogeneous result{1};
    for (std::size_t j = 0; j < used.size(); ++j) {
        if (j == i)
            continue;
        Homogeneous product(result.size() + 1, 0.0L);
        for (std::size_t k = 0; k < result.size(); ++k) {
            product[k] -= (1 + used[j]) * result[k];
            product[k + 1] += (1 - used[j]) * result[k];
        }
        result = product;
        scale(result, 1 / (used[i] - used[j]));
    }
    return result;
}

Homogeneous homogeneous(const Factor& factor, std::uint32_t order) {
    const int n = factor.index;
    Homogeneous f;
    switch (factor.kind) {
    case Kind::one:
        f = {1};
        break;
    case Kind::modified_a:
        f = jacobi_form(std::max(n - 2, 0), 1, 1);
        if (n != 1)
            multiply_by_l(f, 1);
        if (n != 0)
            multiply_by_r(f);
        break;
    case Kind::orthogonal_a:
        f = jacobi_form(n, 0, 0);
        scale(f, std::sqrt(static_cast<long double>(n) + 0.5L));
        break;
    case Kind::gll_lagrange:
    case Kind::gauss_lagrange:
        f = lagrange_form(factor.kind, order, n);
        break;
    case Kind::modified_b:
        f = jacobi_form(std::max(n - 1, 0), 2 * factor.m - 1, 1);
        if (n > 0)
            multiply_by_r(f);
        break;
    case Kind::orthogonal_b:
        f = jacobi_form(n, 2 * factor.m + 1, 0);
        scale(f, std::sqrt(static_cast<long double>(factor.m + n) + 1));
        break;
    case Kind::orthogonal_c:
        f = jacobi_form(n, 2 * factor.m + 2, 0);
        scale(f, std::sqrt(static_cast<long double>(factor.m + n) + 1.5L));
        break;
    }
    multiply_by_l(f, factor.power);
    return f;
}

} // namespace

double bernstein(const Factor& factor, std::uint32_t order, std::span<double> coefficients) {
    std::vector<long double> b = homogeneous(factor, order);
    assert(b.size() <= coefficients.size());
    long double bound = 0;
    for (std::size_t k = 0; k < b.size(); ++k) {
        b[k] /= binomial(static_cast<int>(b.size()) - 1, static_cast<int>(k));
        bound = std::max(bound, std::abs(b[k]));
    }
    // b'_k = k/(d+1) b_{k-1} + (1 - k/(d+1)) b_k  (Farin, Curves and Surfaces for CAGD, 5.1)
    while (b.size() < coefficients.size()) {
        const std::size_t raised = b.size();
        b.push_back(b.back());
        for (std::size_t k = raised - 1; k > 0; --k)
            b[k] = (static_cast<long double>(k) * b[k - 1] + static_cast<long double>(raised - k) * b[k]) /
                   static_cast<long double>(raised);
    }
    for (std::size_t k = 0; k < b.size(); ++k)
        coefficients[k] = static_cast<double>(b[k]);
    return std::nextafter(static_cast<double>(bound), std::numeric_limits<double>::infinity());
}

} // namespace elvis::native
