/**
 * @file bernstein.hpp
 * Bounds of polynomials on the tetrahedron by their Bernstein coefficients, which enclose them (the convex hull property;
 * G. Farin, "Triangular Bernstein-Bezier patches", CAGD 3 (1986)).
 */
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace elvis::dubiner {

struct Range {
    double lower = 0, upper = 0;
};

/** Sums of |first| and of |second| derivatives by xi that no point of the tetrahedron exceeds. */
struct Steepness {
    double first = 0, second = 0;
};

/** Of the polynomials of one order. All bounds hold for coefficients rounded to single precision, too. */
class BernsteinBounds {
public:
    explicit BernsteinBounds(std::size_t order);

    /** Of a polynomial given by coefficients of modes that are not normalised. */
    Range range(std::span<const double> coefficients) const;
    Steepness steepness(std::span<const double> coefficients) const;

private:
    Eigen::VectorXd to_bernstein(std::span<const double> coefficients) const;
    /** More than rounding of coefficients to single precision can change anything. */
    double rounding(std::span<const double> coefficients) const;

    std::size_t m_order;
    /** From modes to Bernstein coefficients. */
    Eigen::MatrixXd m_from_modes;
    /** Largest Bernstein coefficient of each mode. */
    Eigen::VectorXd m_size;
};

/** Points of the lattice of an order, xi1 fastest; that of order 0 is the centre. */
std::vector<std::array<double, 3>> lattice(std::size_t order);

/** All modes (columns) at all points of the lattice of the order (rows). */
Eigen::MatrixXd modes_at_lattice(std::size_t order);

} // namespace elvis::dubiner
