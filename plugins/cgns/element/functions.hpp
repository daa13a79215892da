/**
 * @file functions.hpp
 * The functions that values at an element's nodes determine (format.md, section 4): those of corners, edges, faces and inside,
 * as many of each as there are nodes.
 */
#pragma once

#include "nodes.hpp"

namespace elvis_cgns {

/** Values at a point of nodes.hpp, n_nodes(type) of them. Of triangles to hexahedra. */
std::vector<double> functions(const ElementType& type, const Point& x);

} // namespace elvis_cgns
