/**
 * @file linear_element.hpp
 * Which elements of a curved mesh are linear: they convert to a smaller space, and are drawn faster.
 */
#pragma once

#include "nodal_space.hpp"

namespace elvis::nodal {

/** For elements whose geometry is given at the same nodes. Any thread may ask. */
class LinearElement {
public:
    /** `corners`: which of the nodes are the corners, in the order of elvis/element.h. */
    LinearElement(const NodalSpace& nodes, std::vector<std::size_t> corners);

    /**
     * Whether the mapping is that of the corners, up to rounding: affine in simplices and pyramids, else of order 1 in each
     * direction. `positions`: three numbers a node, finite.
     */
    bool operator()(const double* positions) const;

private:
    native::Shape m_shape;
    std::vector<std::size_t> m_corners;
    /** Values of the corners' linear functions at the nodes. */
    Matrix m_functions;
};

/**
 * Which of the nodes (three numbers each) are the corners, in the order of elvis/element.h; empty if one is missing.
 */
std::vector<std::size_t> corner_nodes(native::Shape shape, std::span<const double> nodes);

} // namespace elvis::nodal
