/**
 * @file basis_1d.hpp
 * One-dimensional bases on [0, 1]: Lagrange polynomials on given points, Bernstein polynomials.
 */
#pragma once

#include "../collection.hpp"

#include <cstddef>
#include <vector>

namespace elvis_mfem {

class Basis1d {
public:
    /** n functions of degree n - 1. */
    Basis1d(Basis basis, int n);

    std::size_t size() const { return m_points.size(); }
    /** Index of the function whose point is nearest. */
    std::size_t nearest(double x) const;
    /** Values of all functions. */
    void evaluate(double x, double* values) const;

private:
    bool m_is_bernstein = false;
    std::vector<double> m_points;
    /** Barycentric weights. */
    std::vector<double> m_weights;
};

} // namespace elvis_mfem
