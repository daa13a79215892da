/**
 * @file projector.hpp
 * Projection of functions on a reference shape onto a native space.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <Eigen/Core>

#include <vector>

namespace elvis {

/** Reference points, three numbers each. */
using PointList = std::vector<double>;

/**
 * Tensor Gauss-Legendre points of the collapsed cube, mapped to the shape: `n` in each direction, all inside. The weights are
 * those of the reference measure. In the collapsed direction of a space of order P, n = P + 2 integrates its products well
 * enough for a projection that is exact on the space (which any unisolvent points give) and near the best fit elsewhere.
 */
struct GaussPoints {
    PointList xi;
    std::vector<double> weights;
};
GaussPoints gauss_points(native::Shape shape, const std::array<std::uint32_t, 3>& n);

/** Equidistant points of the collapsed cube with its boundary, `n` >= 2 in each direction: where a projection is compared. */
PointList check_points(native::Shape shape, std::uint32_t n);

/** Modes of a space at points: one row a point. */
Eigen::MatrixXd mode_matrix(const native::Space& space, const PointList& xi);

/**
 * Matrix (modes x points) of the weighted least-squares projection: argmin over c of sum_k w_k (f(xi_k) - sum_m c_m
 * phi_m(xi_k))^2, by QR of the weighted mode matrix.
 */
Eigen::MatrixXd projection_matrix(const native::Space& space, const GaussPoints& points);

} // namespace elvis
