// Gauss points by Newton's method on Legendre polynomials, in extended precision.
#include "quadrature.hpp"

#include <elvis/native/space.hpp>

#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

namespace elvis::native {
namespace {

struct Legendre {
    long double value;    // P_n
    long double previous; // P_{n-1}
};

Legendre legendre(std::size_t n, long double z) {
    long double previous = 0;
    long double value = 1;
    for (std::size_t k = 1; k <= n; ++k) {
        const auto degree = static_cast<long double>(k);
        const long double next = ((2 * degree - 1) * z * value - (degree - 1) * previous) / degree;
        previous = value;
        value = next;
    }
    return {value, previous};
}

// P_n' = n (P_{n-1} - z P_n) / (1 - z^2)
long double derivative(std::size_t n, long double z, const Legendre& p) {
    return static_cast<long double>(n) * (p.previous - z * p.value) / (1 - z * z);
}

// Newton's method converges quadratically from these starts; a handful of steps reaches the last place for n <= 1000.
constexpr int newton_steps = 12;

} // namespace

void gauss_legendre(std::span<long double> points) {
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
        // Zeros of P_n lie near cos(pi (i + 3/4) / (n + 1/2)) (Abramowitz & Stegun 22.16.6).
        long double z = -std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(i) + 0.75L) /
                                  (static_cast<long double>(n) + 0.5L));
        for (int step = 0; step < newton_steps; ++step) {
            const Legendre p = legendre(n, z);
            z -= p.value / derivative(n, z, p);
        }
        points[i] = 2 * i + 1 == n ? 0 : z;
    }
}

void gauss_lobatto_legendre(std::span<long double> points) {
    assert(points.size() >= 2);
    const std::size_t n = points.size() - 1; // the inner points are the zeros of P_n'
    points.front() = -1;
    points.back() = 1;
    for (std::size_t i = 1; i < n; ++i) {
        long double z = -std::cos(std::numbers::pi_v<long double> * static_cast<long double>(i) / static_cast<long double>(n));
        for (int step = 0; step < newton_steps; ++step) {
            const Legendre p = legendre(n, z);
            const long double slope = derivative(n, z, p);
            // Legendre's equation: (1 - z^2) P'' = 2 z P' - n (n+1) P
            const long double second =
                (2 * z * slope - static_cast<long double>(n) * static_cast<long double>(n + 1) * p.value) / (1 - z * z);
            z -= slope / second;
        }
        points[i] = 2 * i == n ? 0 : z;
    }
}

void gauss_legendre(std::span<double> points, std::span<double> weights) {
    assert(!points.empty() && points.size() == weights.size());
    std::vector<long double> precise(points.size());
    gauss_legendre(precise);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const long double z = precise[i];
        const long double slope = derivative(points.size(), z, legendre(points.size(), z));
        points[i] = static_cast<double>(z);
        weights[i] = static_cast<double>(2 / ((1 - z * z) * slope * slope));
    }
}

void gauss_lobatto_legendre(std::span<double> points) {
    std::vector<long double> precise(points.size());
    gauss_lobatto_legendre(precise);
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = static_cast<double>(precise[i]);
}

} // namespace elvis::native
