/**
 * @file lagrange_nodes.hpp
 * Nodes of VTK's Lagrange cells in native reference coordinates.
 *
 * The order is that of VTK 9.1 and later: corners, edges, faces, interior; see plugins/vtk/format.md.
 */
#pragma once

#include <elvis/element.h>

#include <cstdint>
#include <vector>

namespace elvis {

/** VTK's number of the cell type with Lagrange cells of the shape; of the linear cell for pyramids. */
std::uint8_t vtk_cell_type(elvis_shape shape);

/**
 * Three coordinates a node, in VTK's order. Pyramids are of order 1, because VTK has no others.
 * Wedges run such that VTK finds their Jacobian positive where the native one is.
 */
std::vector<double> lagrange_nodes(elvis_shape shape, std::uint32_t order);

} // namespace elvis
