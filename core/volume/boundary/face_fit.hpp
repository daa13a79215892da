/**
 * @file face_fit.hpp
 * Polynomials through points of element faces: a face of an isoparametric element is one, of the order of the geometry.
 */
#pragma once

#include <span>
#include <vector>

namespace elvis {

/**
 * Interpolation in Chebyshev-Lobatto points of quadrilaterals and in as many points of triangles as there are polynomials of
 * the order, and further points that show how well the polynomial fits.
 */
class FaceFit {
public:
    explicit FaceFit(int order);

    int order() const { return m_order; }
    /** Points of a face, checks included: the same number for both shapes. */
    std::size_t n_points() const { return m_n_points; }
    /** (u, v) of the points of quadrilaterals, then of triangles. */
    std::span<const double> points() const { return m_points; }
    std::size_t n_coefficients() const { return static_cast<std::size_t>((m_order + 1) * (m_order + 1)); }

    /**
     * From three coordinates a point the coefficients of T_i(u) T_j(v), three numbers each, i fastest. Returns the largest
     * difference of a coordinate at the points that the polynomial need not go through. Coefficients are refined once
     * by what they leave at the points: the matrix of triangles has a condition of 5e2 (order 4) to 3e7 (order 10).
     */
    double fit(bool is_triangle, std::span<const double> positions, std::span<double> coefficients) const;

private:
    struct Shape {
        std::size_t n_interpolated = 0;
        /** Coefficients from positions at the first points, and positions at all points from coefficients; row by row. */
        std::vector<double> matrix, values;
    };
    Shape make_shape(bool is_triangle) const;

    int m_order;
    std::size_t m_n_points;
    std::vector<double> m_points;
    Shape m_shapes[2];
};

} // namespace elvis
