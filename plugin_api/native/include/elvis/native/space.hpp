/**
 * @file space.hpp
 * Polynomial spaces of the native volume: one-dimensional modal functions in collapsed coordinates, multiplied.
 *
 * Sources: G. E. Karniadakis, S. J. Sherwin, "Spectral/hp Element Methods for CFD", ch. 3; the mode tables of Nektar++.
 * The specification with every formula is format.md beside this folder.
 */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace elvis::native {

/** Same numbers as elvis_shape in elvis/element.h. */
enum class Shape : std::uint32_t { hexahedron, prism, pyramid, tetrahedron, quadrilateral, triangle };
inline constexpr std::size_t n_shapes = 6;

/** Family of modes. */
enum class Basis : std::uint32_t {
    modified,       ///< Modified_A, _B, _C, ModifiedPyr_C: vertex, edge, face and interior modes
    orthogonal,     ///< Ortho_A, _B, _C, OrthoPyr_C
    gll_lagrange,   ///< Lagrange on Gauss-Lobatto-Legendre points; hexahedron and quadrilateral only
    gauss_lagrange, ///< Lagrange on Gauss-Legendre points; hexahedron and quadrilateral only
    tensor          ///< pyramid only: A_p(eta1) A_q(eta2) A_r(eta3), independent p, q, r, A = Modified_A
};

/** Point in reference or collapsed coordinates; the third is unused in two dimensions. */
using Point = std::array<double, 3>;

/**
 * A space of functions on a reference shape. Order 0 in every direction (any basis) is the constant 1; order 0 in some
 * directions only does not exist.
 *
 * Order of the coefficients, slowest index first; P, Q, R are the orders:
 *   quadrilateral       q, p        p <= P, q <= Q
 *   hexahedron          r, q, p     p <= P, q <= Q, r <= R
 *   triangle            p, q        q <= Q - p                           (P <= Q)
 *   prism               p, q, r     q <= Q, r <= R - p                   (P <= R)
 *   pyramid             p, q, r     r <= R - max(p, q)                   (P = Q = R)
 *   pyramid, tensor     p, q, r     p <= P, q <= Q, r <= R
 *   tetrahedron         p, q, r     q <= Q - p, r <= R - p - q           (P <= Q <= R)
 */
struct Space {
    Shape shape = Shape::hexahedron;
    Basis basis = Basis::modified;
    /** Polynomial order in each direction, 0..max_order; order[2] is 0 in two dimensions. Modes a direction: order + 1. */
    std::array<std::uint32_t, 3> order{};

    friend bool operator==(const Space&, const Space&) = default;
};

inline constexpr std::uint32_t max_order = 30;

int dimension(Shape shape);
int n_corners(Shape shape);
int n_faces(Shape shape);
/** Corners of a local face in the order of elvis/element.h; 3 or 4 of them (2 in two dimensions). */
std::span<const int> face_corners(Shape shape, int local_face);
/** Reference coordinates of a corner. */
Point corner(Shape shape, int index);
std::string_view name(Shape shape);
std::string_view name(Basis basis);

/** Throws std::invalid_argument with the reason if the space does not exist (basis and shape, orders). */
void check(const Space& space);

/** Number of modes, hence of coefficients. */
std::size_t n_modes(const Space& space);

/** Polynomial degree in each collapsed coordinate; (n, n, 2n) in orthogonal and (n, n, max(n, 2n-2)) in modified pyramids. */
std::array<std::uint32_t, 3> collapsed_order(const Space& space);

/** Collapsed coordinates eta of xi; at the singular point or edge, eta = -1 where undetermined. */
Point collapse(Shape shape, const Point& xi);
/** Inverse of collapse. */
Point expand(Shape shape, const Point& eta);
/** Whether xi lies in the closed reference shape, enlarged by `tolerance` in every face. */
bool is_inside(Shape shape, const Point& xi, double tolerance = 0);

/*
 * Evaluation works at every xi, outside the shape too, and never divides by zero: the modes of all shapes but the pyramid are
 * polynomials in xi. Those of modified and tensor pyramids are rational with denominators that vanish at the apex, where values
 * and gradients are their limits along eta1 = eta2 = -1. A gradient of a tensor mode with r = 1 has no limit there; its finite
 * part is returned, because the poles cancel in every function that is continuous at the apex. Spaces are taken as valid
 * (`check`), arguments of other sizes than stated are an error of the caller (assertions).
 */

/** Values of all modes at xi, in the order of coefficients. values.size() == n_modes(space). */
void evaluate_modes(const Space& space, const Point& xi, std::span<double> values);

/** Values and gradients with respect to xi: gradients[3*mode + direction], 0 for the third in two dimensions. */
void evaluate_modes(const Space& space, const Point& xi, std::span<double> values, std::span<double> gradients);

/** Sum of coefficients times modes. */
double evaluate(const Space& space, std::span<const double> coefficients, const Point& xi);

/** The same with the gradient in xi. */
double evaluate(const Space& space, std::span<const double> coefficients, const Point& xi, Point& gradient);

struct Range {
    double lower = 0;
    double upper = 0;
};

/**
 * Certified range over the closed reference shape: no value of the exact function lies outside, the rounding of this
 * computation included (a rounded evaluation may leave it by its own rounding error). From Bernstein coefficients of the
 * polynomial in collapsed coordinates, where every space of this page is a tensor product, or from values at nodes: at most
 * three times as wide as the values are apart. Exact (smallest and largest coefficient) for order 1 in modified, tensor and
 * gll_lagrange bases. Coefficients that are not finite give [-inf, inf].
 */
Range range(const Space& space, std::span<const double> coefficients);

/**
 * `range` for many elements of one space: holds the matrices and the memory for intermediate results, so that a call does not
 * allocate. One thread at a time; copies are independent.
 */
class RangeBounder {
public:
    explicit RangeBounder(const Space& space);
    Range operator()(std::span<const double> coefficients);

    /** Matrices to Bernstein form. */
    struct Tables;

private:
    std::shared_ptr<const Tables> m_tables;
    std::vector<double> m_workspace;
};

/** Gauss-Legendre points and weights on [-1, 1], ascending; n >= 1. */
void gauss_legendre(std::span<double> points, std::span<double> weights);
/** Gauss-Lobatto-Legendre points, ascending, n >= 2. */
void gauss_lobatto_legendre(std::span<double> points);

} // namespace elvis::native
