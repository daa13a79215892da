#include "element_map.hpp"

#include <Eigen/LU>

#include <algorithm>

namespace generator {

namespace {

/** P_0 .. P_n at x. */
void legendre(std::uint32_t n, double x, double* values) {
    values[0] = 1;
    if (n >= 1) {
        values[1] = x;
    }
    for (std::uint32_t k = 2; k <= n; ++k) {
        values[k] = ((2.0 * k - 1) * x * values[k - 1] - (k - 1.0) * values[k - 2]) / k;
    }
}

/**
 * Calls visit(i, j, k) for the index triples of a shape: of its nodes (as multiples of 2/order along xi from -1), and as well
 * of the exponents of its modes, for these are as many.
 */
template <class Visit> void for_each_index(elvis_shape shape, std::uint32_t n, Visit&& visit) {
    for (std::uint32_t k = 0; k <= n; ++k) {
        for (std::uint32_t j = 0; j <= n; ++j) {
            for (std::uint32_t i = 0; i <= n; ++i) {
                const bool inside = shape == ELVIS_SHAPE_PRISM         ? i + k <= n
                                    : shape == ELVIS_SHAPE_PYRAMID     ? i + k <= n && j + k <= n
                                    : shape == ELVIS_SHAPE_TETRAHEDRON ? i + j + k <= n
                                                                       : true;
                if (inside) {
                    visit(i, j, k);
                }
            }
        }
    }
}

} // namespace

ElementMap::ElementMap(elvis_shape shape, std::uint32_t order) : m_shape(shape), m_order(order) {
    const double step = 2.0 / order;
    for_each_index(shape, order, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        m_nodes.push_back({-1 + step * i, -1 + step * j, -1 + step * k});
    });
    const auto n = static_cast<Eigen::Index>(m_nodes.size());
    Eigen::MatrixXd vandermonde(n, n);
    Eigen::RowVectorXd row(n);
    for (Eigen::Index node = 0; node < n; ++node) {
        modes(m_nodes[static_cast<std::size_t>(node)].data(), row);
        vandermonde.row(node) = row;
    }
    m_to_modes = vandermonde.fullPivLu().inverse();
}

void ElementMap::modes(const double* xi, Eigen::RowVectorXd& values) const {
    std::array<double, 64> a{}, b{}, c{};
    Eigen::Index mode = 0;
    if (m_shape == ELVIS_SHAPE_PYRAMID) {
        // P_i(eta1) P_j(eta2) t^max(i, j) P_k(xi3), t = (1 - xi3) / 2; at the apex only i = j = 0 is left.
        const double t = 0.5 * (1 - xi[2]);
        legendre(m_order, t > 0 ? (1 + xi[0]) / t - 1 : 0, a.data());
        legendre(m_order, t > 0 ? (1 + xi[1]) / t - 1 : 0, b.data());
        legendre(m_order, xi[2], c.data());
        std::array<double, 64> power{};
        power[0] = 1;
        for (std::size_t k = 1; k <= m_order; ++k) {
            power[k] = power[k - 1] * t;
        }
        for_each_index(m_shape, m_order, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            values[mode++] = a[i] * b[j] * power[std::max(i, j)] * c[k];
        });
        return;
    }
    legendre(m_order, xi[0], a.data());
    legendre(m_order, xi[1], b.data());
    legendre(m_order, xi[2], c.data());
    for_each_index(m_shape, m_order,
                   [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) { values[mode++] = a[i] * b[j] * c[k]; });
}

Eigen::MatrixX3d ElementMap::interpolate(const std::vector<Vector3>& positions) const {
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> values(
        positions.front().data(), static_cast<Eigen::Index>(positions.size()), 3);
    return m_to_modes * values;
}

Vector3 ElementMap::evaluate(const Eigen::MatrixX3d& coefficients, const double* xi) const {
    thread_local Eigen::RowVectorXd values;
    values.resize(static_cast<Eigen::Index>(m_nodes.size()));
    modes(xi, values);
    const Eigen::RowVector3d x = values * coefficients;
    return {x[0], x[1], x[2]};
}

} // namespace generator
