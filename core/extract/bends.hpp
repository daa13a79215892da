/**
 * @file bends.hpp
 * How bent functions are in elements: what rules out parts of the surface that no corner of a cell shows.
 */
#pragma once

#include <core/extract/surface_sampler.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/element/second_derivatives.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

/** H >= sum over i, j of |d^2 f / dxi_i dxi_j| in an element. */
struct Bend {
    double level = 0, contour = 0;
    /** That of the level is proven. Else it is from samples. */
    bool is_certified = false;
};

/**
 * H of a field's component, of elements in ascending order, as far as the plugin proves it; NaN elsewhere. Pyramids' bounds
 * are of something else, and are left out. Empty where the expression is no component, or the plugin tells nothing.
 */
std::vector<double> certified_bends(const RuntimeVolume& volume, const Expression& expression, std::uint32_t time_step,
                                    std::span<const std::uint64_t> elements);

/**
 * Of polynomials of that degree, in elements of one shape: from their Bernstein form
 * (core/volume/element/second_derivatives.hpp), whose coefficients are nowhere exceeded; but for rounding, certified.
 */
class PolynomialBend {
public:
    /** Not of pyramids, whose functions are rational; of no degree that would take long. */
    static bool can_bound(elvis_shape shape, unsigned degree);
    PolynomialBend(elvis_shape shape, unsigned degree);
    double of(const SurfaceSampler& sampler, std::uint64_t element) const;

private:
    SecondDerivatives m_derivatives;
    std::vector<Vector3> m_nodes;
};

/** From differences of slopes on a lattice of an element. The degree in each direction tells how fine. */
Bend sampled_bend(const SurfaceSampler& sampler, std::uint64_t element, elvis_shape shape, unsigned degree);

/** From the slopes at corners of a cell, whose sampled neighbourhood is the cell alone. Two, three or four corners. */
double local_bend(std::span<const Vector3> corners, std::span<const Vector3> slopes);

/**
 * A function over a simplex in reference coordinates, from values and slopes at its corners. Where points x = sum of l_i x_i,
 * |x - x_i| <= w (1 - l_i) for the largest extent w, so that the sums of l_i |x - x_i| and of l_i |x - x_i|^2 are at most 3/4 w
 * and 9/16 w^2 in a tetrahedron, 2/3 w and 4/9 w^2 in a triangle, 1/2 w and 1/4 w^2 on an edge.
 */
class SimplexFunction {
public:
    SimplexFunction(std::span<const Vector3> corners, std::span<const double> values, std::span<const Vector3> slopes,
                    double bend);
    /** No zero is in the simplex. */
    bool is_nowhere_zero() const { return m_is_nowhere_zero; }
    /** No value in the simplex is larger, or smaller than the opposite. */
    double largest() const { return m_largest; }
    /** The function grows along some direction; along one in the plane with a normal of length 1; along this one or its
     * opposite. */
    bool is_monotone() const { return grows_along(mean_slope()); }
    bool is_monotone_in_plane(const Vector3& normal) const;
    bool is_monotone_along(const Vector3& direction) const;

private:
    Vector3 mean_slope() const;
    bool grows_along(const Vector3& direction) const;

    std::span<const Vector3> m_corners, m_slopes;
    double m_bend, m_width = 0, m_largest = 0;
    bool m_is_nowhere_zero = false;
};

} // namespace elvis
