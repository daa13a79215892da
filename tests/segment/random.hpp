/**
 * @file random.hpp
 * Polynomials and numbers for the tests of segments.
 */
#pragma once

#include <core/segment/polynomial.hpp>

#include <random>

namespace elvis::test {

class Random {
public:
    explicit Random(std::uint64_t seed) : m_engine(seed) {}
    double between(double lower, double upper) { return std::uniform_real_distribution<double>(lower, upper)(m_engine); }

    /** Chebyshev coefficients that decay at a random rate, exact in single precision. */
    template <class Real> segment::Polynomial<Real> chebyshev(int degree) {
        segment::Polynomial<Real> p{degree, {}};
        const double ratio = between(0.3, 1);
        double size = 1;
        for (int k = 0; k <= degree; ++k) {
            // Whole multiples of a power of two.
            p[k] = static_cast<Real>(std::round(size * between(-1, 1) * 0x1p20) * 0x1p-20);
            size *= ratio;
        }
        return p;
    }

private:
    std::mt19937_64 m_engine;
};

/** Bernstein coefficients of (t - r_1) .. (t - r_n) times `scale`, raised to `degree`. */
inline segment::Polynomial<double> from_roots(const std::vector<double>& roots, int degree, double scale = 1) {
    segment::Polynomial<double> p{0, {}};
    p[0] = scale;
    const auto multiply = [&](double at_zero, double at_one) {
        segment::Polynomial<double> product{p.degree + 1, {}};
        for (int i = 0; i <= product.degree; ++i) {
            const double weight = static_cast<double>(i) / product.degree;
            product[i] = (i > 0 ? weight * at_one * p[i - 1] : 0) + (i < product.degree ? (1 - weight) * at_zero * p[i] : 0);
        }
        p = product;
    };
    for (const double root : roots) {
        multiply(-root, 1 - root);
    }
    while (p.degree < degree) {
        multiply(1, 1);
    }
    return p;
}

} // namespace elvis::test
