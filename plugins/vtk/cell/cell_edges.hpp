/**
 * @file cell_edges.hpp
 * The nodes along the edges of Lagrange cells.
 */
#pragma once

#include "cell_kind.hpp"

#include <vector>

namespace elvis_vtk {

/** For each edge its nodes from end to end. Of families tensor, simplex and wedge. */
std::vector<std::vector<std::size_t>> edge_nodes(const CellKind& kind);

} // namespace elvis_vtk
