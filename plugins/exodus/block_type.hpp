/**
 * @file block_type.hpp
 * The types of elements that blocks of Exodus II files hold.
 */
#pragma once

#include <plugins/cgns/element/element_type.hpp>

#include <cstddef>
#include <span>
#include <string>

namespace elvis_exodus {

using elvis_cgns::ElementType;
using elvis_cgns::Topology;

/**
 * The type by name and number of nodes, as HEX8 and HEXAHEDRON with 27 nodes; names are those of the Exodus II manual, and what
 * writers make of them. Throws std::invalid_argument for types that are not read. Blocks of points and lines have a topology
 * below those of the plane.
 */
ElementType block_type(const std::string& name, std::size_t n_nodes);

/** Of each node of CGNS's order (plugins/cgns/element/nodes.hpp), its place in Exodus's; none where both are the same. */
std::span<const int> node_order(const ElementType& type);

/** Corners of a side, counted from 0; sides count from 1. Empty if the type has no such side, or if it is none of its faces. */
std::span<const int> side_corners(Topology topology, std::int64_t side);

} // namespace elvis_exodus
