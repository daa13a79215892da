/**
 * @file interpolation.hpp
 * Isoparametric geometry: the polynomial (on pyramids: rational) map through the exact positions of an element's nodes.
 *
 * Spaces: Q_g on hexahedra, P_g of the triangle times P_g on prisms, P_g on tetrahedra, and on pyramids the optimal space of
 * M. Bergot, G. Cohen, M. Durufle, "Higher-order finite elements for hybrid meshes using new nodal pyramidal elements",
 * J. Sci. Comput. 42 (2010), whose traces are Q_g on the base and P_g on the triangles. Nodes on a face determine the map on
 * that face, and both sides of a face have the same nodes on it; so neighbours fit without a gap.
 *
 * Nodes: Gauss-Lobatto-Legendre along edges, continued into triangles and tetrahedra by T. Isaac, "Recursive, parameter-free,
 * explicitly defined interpolation nodes for simplices", SIAM J. Sci. Comput. 42 (2020).
 */
#pragma once

#include "cell_split.hpp"

#include <Eigen/Dense>

#include <cstdint>
#include <span>
#include <vector>

namespace generator {

class Interpolation {
public:
    Interpolation(elvis_shape shape, std::uint32_t order);

    /** Reference coordinates. */
    const std::vector<Vec3>& nodes() const { return m_nodes; }

    /**
     * Weights of the nodes at points given in reference coordinates (3 numbers a point): a row a point, a column a node.
     * The host asks for the same points again and again: each thread keeps the last few answers, and the reference is valid
     * until the thread's next call.
     */
    const Eigen::MatrixXd& weights(std::span<const double> xi) const;

private:
    elvis_shape m_shape;
    int m_order;
    /** Tells kept answers of different objects apart, of those that are gone too. */
    std::uint64_t m_serial;
    std::vector<Vec3> m_nodes;
    /** Inverse of the generalised Vandermonde matrix. */
    Eigen::MatrixXd m_inverse;
};

} // namespace generator
