/**
 * @file chebyshev.hpp
 * Polynomials on [-1, 1] in Chebyshev form.
 */
#pragma once

#include <span>
#include <vector>

namespace elvis::oracle {

/** -cos(pi i / n) for i = 0..n, ascending: the points at which a series of degree n is taken. */
std::span<const double> lobatto_points(std::size_t n);

class ChebyshevSeries {
public:
    ChebyshevSeries() = default;
    /** The interpolant through values at lobatto_points(values.size() - 1). */
    explicit ChebyshevSeries(std::span<const double> values);

    double operator()(double s) const;
    /** Its integral from -1. */
    ChebyshevSeries antiderivative() const;
    ChebyshevSeries derivative() const;
    std::size_t degree() const { return m_coefficients.size() - 1; }

    /** Largest coefficient of the last quarter, and of all. */
    double tail() const;
    double size() const;

    /** Values at lobatto_points(4 * degree()), faster than one after the other. */
    std::vector<double> dense_values() const;

    /**
     * Where the series takes the value `level` in [-1, 1], ascending: eigenvalues of the colleague matrix (the companion matrix
     * of Chebyshev form; I. J. Good, "The colleague matrix, a Chebyshev analogue of the companion matrix", 1961), whose
     * imaginary part and excess over [-1, 1] are rounding.
     */
    std::vector<double> companion_roots(double level) const;

private:
    std::vector<double> m_coefficients;
};

/** Value at s of the polynomial through values at lobatto_points(values.size() - 1), by the barycentric formula. */
template <class Value> Value interpolate(const std::vector<Value>& values, double s) {
    const std::size_t n = values.size() - 1;
    const std::span<const double> points = lobatto_points(n);
    Value sum = 0 * values[0];
    double weights = 0;
    for (std::size_t i = 0; i <= n; ++i) {
        if (s == points[i])
            return values[i];
        const double weight = (i % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i == n ? 0.5 : 1.0) / (s - points[i]);
        sum += weight * values[i];
        weights += weight;
    }
    return sum / weights;
}

} // namespace elvis::oracle
