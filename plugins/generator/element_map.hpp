/**
 * @file element_map.hpp
 * Curved elements: polynomial interpolation of a smooth map at equidistant nodes of the reference shape.
 *
 * The interpolant on a face depends on the nodes of that face alone, and neighbours have the same nodes there: the mesh of
 * interpolated elements has neither gaps nor overlaps. It, not the smooth map, is the geometry that the generator stands for.
 */
#pragma once

#include "blocks.hpp"

#include <elvis/element.h>

#include <Eigen/Core>

#include <vector>

namespace generator {

/** Nodes and interpolation of one shape and order. Immutable. */
class ElementMap {
public:
    /**
     * Polynomials of degree `order`: in each direction for the hexahedron and a prism's axis, in total for triangles and
     * tetrahedra; for the pyramid the space of Bergot, Cohen and Durufle (2010), which has these on its faces.
     */
    ElementMap(elvis_shape shape, std::uint32_t order);

    /** Equidistant nodes, reference coordinates. */
    const std::vector<Vector3>& nodes() const { return m_nodes; }

    /** Coefficients (modes x 3) of the interpolant through these positions of the nodes. */
    Eigen::MatrixX3d interpolate(const std::vector<Vector3>& positions) const;

    Vector3 evaluate(const Eigen::MatrixX3d& coefficients, const double* xi) const;

private:
    void modes(const double* xi, Eigen::RowVectorXd& values) const;

    elvis_shape m_shape;
    std::uint32_t m_order;
    std::vector<Vector3> m_nodes;
    Eigen::MatrixXd m_to_modes;
};

} // namespace generator
