#include "basis.hpp"

#include <cmath>

namespace elvis::dubiner {

namespace {

Mode linear(double constant, const Point& slope, const Point& xi) {
    return {constant + slope[0] * xi[0] + slope[1] * xi[1] + slope[2] * xi[2], slope};
}

Mode operator*(const Mode& a, const Mode& b) {
    Mode product{a.value * b.value, {}};
    for (std::size_t d = 0; d < 3; ++d) {
        product.gradient[d] = a.value * b.gradient[d] + a.gradient[d] * b.value;
    }
    return product;
}

/** a x + b y */
Mode combine(double a, const Mode& x, double b, const Mode& y) {
    Mode sum{a * x.value + b * y.value, {}};
    for (std::size_t d = 0; d < 3; ++d) {
        sum.gradient[d] = a * x.gradient[d] + b * y.gradient[d];
    }
    return sum;
}

} // namespace

Recurrence::Recurrence(std::size_t order, std::size_t weight) {
    const double n = static_cast<double>(order), alpha = static_cast<double>(weight);
    a = (2 * n + 1 + alpha) * (2 * n + 2 + alpha) / (2 * (n + 1) * (n + 1 + alpha));
    b = alpha * alpha * (2 * n + 1 + alpha) / (2 * (n + 1) * (n + 1 + alpha) * (2 * n + alpha));
    c = n * (n + alpha) * (2 * n + 2 + alpha) / ((n + 1) * (n + 1 + alpha) * (2 * n + alpha));
}

void evaluate_modes(std::size_t order, const Point& xi, std::span<Mode> modes) {
    // Kirby's factors 1 to 5; the last is the square of the fourth.
    const Mode f1 = linear(1, {1, 0.5, 0.5}, xi);
    const Mode half = linear(0, {0, 0.5, 0.5}, xi);
    const Mode f2 = half * half;
    const Mode f3 = linear(0.5, {0, 1, 0.5}, xi);
    const Mode f4 = linear(0.5, {0, 0, -0.5}, xi);
    const Mode f5 = f4 * f4;
    std::size_t mode = 0;
    Mode before_p, in_p{1, {}};
    for (std::size_t p = 0; p <= order; ++p) {
        Mode before_q, in_q = in_p;
        for (std::size_t q = 0; p + q <= order; ++q) {
            Mode before_r, in_r = in_q;
            for (std::size_t r = 0; p + q + r <= order; ++r) {
                modes[mode++] = in_r;
                const Recurrence step(r, 2 * (p + q) + 2);
                const Mode next = combine(1, linear(step.b, {0, 0, step.a}, xi) * in_r, -step.c, before_r);
                before_r = in_r;
                in_r = next;
            }
            const Recurrence step(q, 2 * p + 1);
            const Mode next = combine(1, combine(step.a, f3, step.b, f4) * in_q, -step.c, f5 * before_q);
            before_q = in_q;
            in_q = next;
        }
        const double n = static_cast<double>(p);
        const Mode next = combine((2 * n + 1) / (n + 1), f1 * in_p, -n / (n + 1), f2 * before_p);
        before_p = in_p;
        in_p = next;
    }
}

void normalisation(std::size_t order, std::span<double> factors) {
    std::size_t mode = 0;
    for (std::size_t p = 0; p <= order; ++p) {
        for (std::size_t q = 0; p + q <= order; ++q) {
            for (std::size_t r = 0; p + q + r <= order; ++r) {
                const double a = static_cast<double>(p), b = static_cast<double>(p + q), c = static_cast<double>(p + q + r);
                factors[mode++] = std::sqrt((a + 0.5) * (b + 1) * (c + 1.5));
            }
        }
    }
}

} // namespace elvis::dubiner
