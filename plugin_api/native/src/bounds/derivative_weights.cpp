#include "derivative_weights.hpp"

#include "../basis/jets.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

namespace elvis::native::device {
namespace {

using native::Shape;

/** Nodes for each degree: the bounds are too large by 1/cos(pi/32) = 1.005 at most. */
constexpr int nodes_per_degree = 16;

/** Evaluated polynomials are wrong by some 1e-14 of their largest value: three-term recurrences up to degree 50. */
constexpr double rounding = 1 + 1e-12;

/** Bounds of the absolute values of several polynomials of degree `degree` on [-1, 1]; function(z) returns their values at z.
 */
template <std::size_t n, class Function> std::array<double, n> suprema(int degree, Function function) {
    const int m = std::max(nodes_per_degree * degree, 1);
    std::array<double, n> largest{};
    for (int j = 0; j <= m; ++j) {
        const std::array<double, n> values = function(std::cos(std::numbers::pi * j / m));
        for (std::size_t i = 0; i < n; ++i)
            largest[i] = std::max(largest[i], std::abs(values[i]));
    }
    for (double& number : largest)
        number *= rounding / std::cos(std::numbers::pi * degree / (2 * m));
    return largest;
}

/** Bounds of a factor: of itself, of the sum of its slopes, and of the sum of its second derivatives (all nine). */
struct FactorBounds {
    double value = 1, first = 0, second = 0;
};

FactorBounds chebyshev_bounds(int n) {
    const double squared = double(n) * n;
    return {1, squared, squared * (squared - 1) / 3};
}

/**
 * The factor t^k g(x/t) without its powers of t, where x grows by 1 along one direction, and along `n_down` others x grows by
 * 1/2 and t falls by 1/2. g(u) is a jet of degree `degree`, and what results is multiplied by a power of (1 - u)/2: `weight`
 * less the number of derivatives that were taken of another factor.
 */
struct Homogeneous {
    int degree = 0, k = 0, n_down = 1;

    template <class Function> FactorBounds bounds(Function g, int weight) const {
        const auto sup = suprema<6>(degree + std::max(weight, 0), [&](double u) -> std::array<double, 6> {
            const Jet f = g(Jet{u, 1, 0});
            const double scale = power((1 - u) / 2, std::max(weight, 0));
            const double down = ((1 + u) * f.first - k * f.value) / 2;
            const double down_slope = ((1 + u) * f.second + (1 - k) * f.first) / 2;
            const double down_twice = ((1 + u) * down_slope - (k - 1) * down) / 2;
            return {scale * f.value, scale * f.first, scale * down, scale * f.second, scale * down_slope, scale * down_twice};
        });
        return {sup[0], sup[1] + n_down * sup[2], sup[3] + 2 * n_down * sup[4] + n_down * n_down * sup[5]};
    }
};

/** A product that is 0 where a factor is 0, whatever the other one is. */
double times(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

/** Bounds of t^power d^n/dz^n J^a_r(z), t = (1 - z)/2, n = 0, 1, 2; infinite for negative powers. */
class LastFactor {
public:
    double operator()(int a, int r, int power_of_t, int n_derivatives) {
        if (power_of_t < 0)
            return infinity;
        const auto key = std::make_tuple(a, r, power_of_t);
        auto found = m_known.find(key);
        if (found == m_known.end()) {
            const auto sup = suprema<3>(r + power_of_t, [&](double z) -> std::array<double, 3> {
                const Jet f = jacobi(a, r, Jet{z, 1, 0});
                const double scale = power((1 - z) / 2, power_of_t);
                return {scale * f.value, scale * f.first, scale * f.second};
            });
            found = m_known.emplace(key, sup).first;
        }
        return found->second[static_cast<std::size_t>(n_derivatives)];
    }

private:
    std::map<std::tuple<int, int, int>, std::array<double, 3>> m_known;
};

/** Bounds of a function a b c, where a and b have lost their powers of t. */
struct Product {
    FactorBounds a;
    /** Of the second factor beside 0, 1 and 2 derivatives of the first: its weight may depend on them. */
    std::array<FactorBounds, 3> b;
    /** Powers of t left beside c before any derivative, and how many a derivative of b takes. */
    int exponent = 0, loss = 1;
    /** Powers of t by which second derivatives are multiplied. */
    int spare = 0;

    /** c(power, n): bound of t^power d^n c / dz^n. */
    template <class LastBound> DerivativeBound bound(LastBound c) const {
        const auto term = [&](double factors, int power_of_t, int n) {
            return factors == 0 ? 0 : times(factors, c(power_of_t, n));
        };
        DerivativeBound result;
        result.first = term(a.first * b[1].value, exponent - 1, 0) + term(a.value * b[0].first, exponent - loss, 0) +
                       term(a.value * b[0].value, exponent, 1);
        const int all = exponent + spare;
        result.second = term(a.second * b[2].value, all - 2, 0) + 2 * term(a.first * b[1].first, all - 1 - loss, 0) +
                        term(a.value * b[0].second, all - 2 * loss, 0) + 2 * term(a.first * b[1].value, all - 1, 1) +
                        2 * term(a.value * b[0].first, all - loss, 1) + term(a.value * b[0].value, all, 2);
        return result;
    }
};

/** Powers of t that belong to the first and the second factor of a pyramid: their own degrees, where there are enough. */
std::array<int, 2> split_exponent(int exponent, int p) {
    const int first = std::min(exponent, p);
    return {first, exponent - first};
}

} // namespace

DerivativeWeights::DerivativeWeights(const DeviceSpace& space, SecondDerivatives second_derivatives) {
    LastFactor last;
    const auto jet_of = [&space](int p) {
        return [&space, p](const Jet& u) {
            return space.has_inner_functions() && p >= 2 ? 0.25 * ((1 - u * u) * jacobi_11(p - 2, u)) : jacobi(0, p, u);
        };
    };
    if (space.shape == Shape::hexahedron) {
        for (int r = 0; r <= space.r_max; ++r)
            for (int q = 0; q <= space.q_max; ++q)
                for (int p = 0; p <= space.p_max; ++p) {
                    const FactorBounds x = chebyshev_bounds(p);
                    const FactorBounds y = chebyshev_bounds(q);
                    const FactorBounds z = chebyshev_bounds(r);
                    add(x.first + y.first + z.first,
                        x.second + y.second + z.second + 2 * (x.first * y.first + x.first * z.first + y.first * z.first));
                }
    } else if (space.shape == Shape::prism) {
        for (int q = 0; q <= space.q_max; ++q)
            for (int p = 0; p <= space.p_max; ++p) {
                const FactorBounds b = chebyshev_bounds(q);
                const Product product{Homogeneous{p, p, 1}.bounds(jet_of(p), 0), {b, b, b}, p, 0};
                for (int r = 0; r < space.n_r(p, q); ++r) {
                    const DerivativeBound bound =
                        product.bound([&](int power_of_t, int n) { return last(2 * p + 1, r, power_of_t, n); });
                    add(bound.first, bound.second);
                }
            }
    } else {
        const bool is_tetrahedron = space.shape == Shape::tetrahedron;
        for (int p = 0; p <= space.p_max; ++p)
            for (int q = 0; q < space.n_q(p); ++q)
                for (int r = 0; r < space.n_r(p, q); ++r) {
                    // r = 0 is 1 alone where has_apex.
                    const bool is_apex = space.has_apex(p, q) && r == 0;
                    const int degree = space.has_apex(p, q) ? std::max(r - 1, 0) : r;
                    const int exponent = is_apex ? 0 : is_tetrahedron ? p + q : space.exponent(p, q);
                    const std::array<int, 2> powers = is_tetrahedron ? std::array<int, 2>{p, q} : split_exponent(exponent, p);
                    Product product;
                    product.exponent = exponent;
                    product.spare = !is_tetrahedron && second_derivatives == SecondDerivatives::apex_weighted ? 1 : 0;
                    product.a = Homogeneous{p, powers[0], is_tetrahedron ? 2 : 1}.bounds(jet_of(p), 0);
                    const Homogeneous second{q, powers[1], 1};
                    for (int taken = 0; taken < 3; ++taken)
                        product.b[static_cast<std::size_t>(taken)] =
                            is_tetrahedron ? second.bounds([&](const Jet& v) { return jacobi(2 * p + 1, q, v); }, p - taken)
                                           : second.bounds(jet_of(q), 0);
                    const int a = 2 * exponent + 2;
                    const DerivativeBound bound =
                        product.bound([&](int power_of_t, int n) { return last(a, degree, power_of_t, n); });
                    add(bound.first, bound.second);
                }
    }
    assert(m_first.size() == space.n_modes());
}

void DerivativeWeights::add(double first, double second) {
    if (std::isinf(first))
        m_without_first.push_back(m_first.size());
    if (std::isinf(second))
        m_without_second.push_back(m_second.size());
    m_first.push_back(first);
    m_second.push_back(second);
    m_finite_first.push_back(std::isinf(first) ? 0 : first);
    m_finite_second.push_back(std::isinf(second) ? 0 : second);
    m_largest_first = std::max(m_largest_first, m_finite_first.back());
    m_largest_second = std::max(m_largest_second, m_finite_second.back());
}

DerivativeBound DerivativeWeights::bound(std::span<const double> coefficients) const {
    assert(coefficients.size() == m_first.size());
    // Several sums at once: a single one would wait for each addition.
    constexpr std::size_t n_lanes = 4;
    std::array<double, n_lanes> size{}, first{}, second{};
    const auto take = [&](std::size_t mode, std::size_t lane) {
        const double c = std::abs(coefficients[mode]);
        size[lane] += c;
        first[lane] += c * m_finite_first[mode];
        second[lane] += c * m_finite_second[mode];
    };
    std::size_t mode = 0;
    for (; mode + n_lanes <= coefficients.size(); mode += n_lanes)
        for (std::size_t lane = 0; lane < n_lanes; ++lane)
            take(mode + lane, lane);
    for (; mode < coefficients.size(); ++mode)
        take(mode, 0);
    const auto sum = [](const std::array<double, n_lanes>& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); };
    // The conversion is exact to 1e-13 of the coefficients (measured: 2e-13 of values at order 14). Coefficients rounded to
    // single precision grow by 2^-24 of themselves, and these sums are exact to 1e-12.
    constexpr double conversion_error = 1e-13;
    constexpr double growth = 1 + 1e-6;
    DerivativeBound result{growth * (sum(first) + conversion_error * m_largest_first * sum(size)),
                           growth * (sum(second) + conversion_error * m_largest_second * sum(size))};
    for (const std::size_t m : m_without_first)
        result.first = coefficients[m] == 0 ? result.first : infinity;
    for (const std::size_t m : m_without_second)
        result.second = coefficients[m] == 0 ? result.second : infinity;
    return result;
}

} // namespace elvis::native::device
