/**
 * @file lattice.hpp
 * Where Gmsh's nodes lie in its reference elements, in the order of the file (format.md, "Nodes").
 */
#pragma once

#include "element_type.hpp"

#include <array>
#include <vector>

namespace gmsh {

/**
 * Position of a node in steps of 1/order along Gmsh's reference axes, from the first corner; see `lattice_point`. In pyramids
 * the third is the height, and the first two count from the corner (-(1-w), -(1-w), w) of the section at that height.
 */
using LatticeIndex = std::array<int, 3>;

/** Nodes of an element of two or three dimensions. */
std::vector<LatticeIndex> lattice(const ElementType& type);

/** Reference coordinates (u, v, w) of Gmsh. */
std::array<double, 3> lattice_point(Topology topology, int order, const LatticeIndex& index);

} // namespace gmsh
