/**
 * @file basis.hpp
 * Dubiner's modal basis of the tetrahedron without collapsed coordinates.
 *
 * The modes are those of M. Dubiner, "Spectral methods on triangles and other domains", J. Sci. Comput. 6 (1991), orthonormal
 * over the reference tetrahedron of elvis/element.h. They are evaluated by the recurrences of R. C. Kirby, "Singularity-free
 * evaluation of collapsed-coordinate orthogonal polynomials", ACM Trans. Math. Softw. 37 (2010), which divide by nothing, so
 * that edges and vertices are places like any other. The snippet does the same on the device.
 */
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace elvis::dubiner {

using Point = std::array<double, 3>;

/** Largest order of fields and of elements. */
inline constexpr std::size_t max_order = 8;

/** Of all polynomials of an order. */
constexpr std::size_t n_modes(std::size_t order) { return (order + 1) * (order + 2) * (order + 3) / 6; }

/** P_(n+1) = (a x + b) P_n - c P_(n-1) for Jacobi polynomials P^(alpha, 0), alpha > 0. */
struct Recurrence {
    double a = 0, b = 0, c = 0;

    /** @param order n, @param weight alpha */
    Recurrence(std::size_t order, std::size_t weight);
};

/** A mode, or any polynomial, at a point. */
struct Mode {
    double value = 0;
    Point gradient{};
};

/**
 * All modes of an order at a point, those of orders p, q, r with p + q + r <= order; r runs fastest, p slowest. Not normalised:
 * times normalisation() they have norm 1.
 * @param modes  n_modes(order) of them
 */
void evaluate_modes(std::size_t order, const Point& xi, std::span<Mode> modes);

/** What makes each mode orthonormal, in the same order; n_modes(order) numbers. */
void normalisation(std::size_t order, std::span<double> factors);

} // namespace elvis::dubiner
