/**
 * @file projector.hpp
 * Coefficients in a device space of a function that is known on a grid of Gauss points.
 */
#pragma once

#include <elvis/native/device_space.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <span>
#include <vector>

namespace elvis::native::device {

/** Gauss-Legendre points and weights. */
struct GaussPoints {
    std::vector<double> points, weights;
    explicit GaussPoints(std::size_t n) : points(n), weights(n) { native::gauss_legendre(points, weights); }
};

/**
 * Matrix from values at the nodes to coefficients of n functions factor(index, z), by least squares with Gauss' weights times
 * weight(z). Exact for functions in the span of the factors, and well conditioned where the factors are nearly orthogonal under
 * this weight, as all of ours are.
 */
template <class Factor, class Weight>
Eigen::MatrixXd fit_matrix(const GaussPoints& nodes, std::size_t n, Factor factor, Weight weight) {
    const auto n_nodes = static_cast<Eigen::Index>(nodes.points.size());
    Eigen::MatrixXd values(n_nodes, static_cast<Eigen::Index>(n));
    Eigen::VectorXd scale(n_nodes);
    for (Eigen::Index i = 0; i < n_nodes; ++i) {
        const double z = nodes.points[static_cast<std::size_t>(i)];
        scale[i] = std::sqrt(nodes.weights[static_cast<std::size_t>(i)] * weight(z));
        for (Eigen::Index j = 0; j < values.cols(); ++j)
            values(i, j) = scale[i] * factor(static_cast<std::size_t>(j), z);
    }
    return Eigen::HouseholderQR<Eigen::MatrixXd>(values).solve(Eigen::MatrixXd(scale.asDiagonal()));
}

template <class Factor> Eigen::MatrixXd fit_matrix(const GaussPoints& nodes, std::size_t n, Factor factor) {
    return fit_matrix(nodes, n, factor, [](double) { return 1.0; });
}

/** Fits direction 1, then 2, then 3, where the functions of a direction may depend on the indices of those before. */
class Projector {
public:
    /** For functions of degree `degree_3` in eta3; their degrees in eta1 and eta2 are those of the space. */
    Projector(const DeviceSpace& space, std::uint32_t degree_3);

    /** Points in collapsed coordinates. */
    const std::vector<native::Point>& grid() const { return m_grid; }

    /** From values at grid() to coefficients in the order p, q, r (r fastest). */
    void project(std::span<const double> values, std::span<double> coefficients) const;

private:
    Eigen::Index m_n_1, m_n_2, m_n_3;
    std::vector<native::Point> m_grid;
    Eigen::MatrixXd m_first;
    /** By p, then (over all p) by q. */
    std::vector<Eigen::MatrixXd> m_second, m_third;
};

} // namespace elvis::native::device
