#include "polynomial.hpp"

#include <cmath>

namespace elvis::cut_cells {

namespace {

/** More than rounding of coefficients to single precision, and of these sums, can change. */
constexpr double widening = 1e-6;

using Numbers = std::array<double, max_order + 1>;

Numbers legendre(double t) { return {1, t, (3 * t * t - 1) / 2, (5 * t * t - 3) * t / 2}; }
Numbers legendre_slopes(double t) { return {0, 1, 3 * t, (15 * t * t - 3) / 2}; }

/** Calls action(mode, i, j, k). */
template <class Action> void for_each_mode(std::size_t order, const Action& action) {
    std::size_t mode = 0;
    for (std::size_t k = 0; k <= order; ++k) {
        for (std::size_t j = 0; j <= order; ++j) {
            for (std::size_t i = 0; i <= order; ++i) {
                action(mode++, i, j, k);
            }
        }
    }
}

} // namespace

PolynomialValue evaluate(std::size_t order, std::span<const double> modes, const double* xi) {
    const std::array<Numbers, 3> values{legendre(xi[0]), legendre(xi[1]), legendre(xi[2])};
    const std::array<Numbers, 3> slopes{legendre_slopes(xi[0]), legendre_slopes(xi[1]), legendre_slopes(xi[2])};
    PolynomialValue sum;
    for_each_mode(order, [&](std::size_t mode, std::size_t i, std::size_t j, std::size_t k) {
        sum.value += modes[mode] * values[0][i] * values[1][j] * values[2][k];
        sum.gradient[0] += modes[mode] * slopes[0][i] * values[1][j] * values[2][k];
        sum.gradient[1] += modes[mode] * values[0][i] * slopes[1][j] * values[2][k];
        sum.gradient[2] += modes[mode] * values[0][i] * values[1][j] * slopes[2][k];
    });
    return sum;
}

PolynomialBounds bounds_of(std::size_t order, std::span<const double> modes) {
    constexpr Numbers steepest{0, 1, 3, 6}, most_bent{0, 0, 3, 15};
    double size = 0, slope = 0, bend = 0;
    for_each_mode(order, [&](std::size_t mode, std::size_t i, std::size_t j, std::size_t k) {
        const double c = std::abs(modes[mode]);
        size += mode == 0 ? 0 : c;
        slope += c * (steepest[i] + steepest[j] + steepest[k]);
        bend += c * (most_bent[i] + most_bent[j] + most_bent[k] +
                     2 * (steepest[i] * steepest[j] + steepest[j] * steepest[k] + steepest[k] * steepest[i]));
    });
    const double rounding = widening * (std::abs(modes[0]) + size);
    return {modes[0] - size - rounding, modes[0] + size + rounding, (1 + widening) * slope, (1 + widening) * bend};
}

} // namespace elvis::cut_cells
