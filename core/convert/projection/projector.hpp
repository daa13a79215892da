/**
 * @file projector.hpp
 * Projection of functions on a reference shape onto a native space.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace elvis {

/** Reference points, three numbers each. */
using PointList = std::vector<double>;

/**
 * Tensor Gauss-Legendre points of the collapsed cube, mapped to the shape: `n` in each direction, all inside. The weights are
 * those of the reference measure. For a space of collapsed order P, n = P + 1 determines each of its functions; one more point
 * brings the projection of other functions close to the best fit.
 */
struct GaussPoints {
    PointList xi;
    std::vector<double> weights;
};
GaussPoints gauss_points(native::Shape shape, const std::array<std::uint32_t, 3>& n);

/** Volume (area) of the reference shape for one of the collapsed cube, at eta: product of (1 - eta_j)/2 for what is collapsed.
 */
double collapse_factor(native::Shape shape, const native::Point& eta);

/**
 * Where a projection is compared with its source: the corners, and `n` points scattered over the shape, boundary included,
 * without the symmetries and nodes of any basis (R. Roberts' R3 sequence in collapsed coordinates).
 */
PointList check_points(native::Shape shape, std::size_t n);

/** Modes of a space at points: one row a point. */
Eigen::MatrixXd mode_matrix(const native::Space& space, const PointList& xi);

/**
 * Matrix (modes x points) of the weighted least-squares fit: argmin over c of sum_k w_k (f(xi_k) - sum_m M_km c_m)^2, for mode
 * values M of full rank.
 */
Eigen::MatrixXd fit_matrix(const Eigen::MatrixXd& modes, std::span<const double> weights);

/** A linear projection: coefficients = matrix * values at points. */
struct PointProjection {
    PointList xi;
    /** modes x points */
    Eigen::MatrixXd matrix;
};

/**
 * The fit over a whole element, from n Gauss points in each direction. Modified hexahedra and prisms and tensor pyramids are
 * products of smaller fits, which keeps orders above ten cheap to prepare.
 */
PointProjection element_projection(const native::Space& space, const std::array<std::uint32_t, 3>& n);

/** The fit (interior modes x points) of the interior modes alone of a modified hexahedron, from n Gauss points in each
 * direction. */
Eigen::MatrixXd bubble_projection(const native::Space& space, const std::array<std::uint32_t, 3>& n);

} // namespace elvis
