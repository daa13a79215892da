/**
 * @file node_spacing.hpp
 * Whether Lagrange cells have the equidistant nodes that VTK means, or those of a solver. format.md says how it is told.
 */
#pragma once

#include "../grid.hpp"

namespace elvis_vtk {

/**
 * Marks the kinds of quadrilaterals and hexahedra whose nodes are Gauss-Lobatto points, with a warning. Refuses other nodes
 * that are not equidistant, and those of other shapes, of which only the ones on edges would be known. Notes
 * and warns where edges disagree.
 */
void adopt_node_spacing(Grid& grid, const std::string& path, const elvis::api::Host& host);

} // namespace elvis_vtk
