/**
 * @file cell_connectivity.hpp
 * Which of the node orders in use a file's cells follow. format.md says where they come from.
 */
#pragma once

#include "cell_kind.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace elvis_vtk {

/** A cell of a grid: its points are connectivity[first ..]. */
struct Cell {
    std::uint64_t first = 0;
    std::uint32_t kind = 0;
    /** Which of the cells that the pieces have, those counted that are left out. */
    std::uint64_t source = 0;
};

/**
 * Brings Lagrange and Bezier hexahedra and wedges of one file into the order of node_order.hpp, and marks wedges as mirrored
 * where that gives positive Jacobians to most of them. `declares_old_hexahedra`: the file's version is below 2.1.
 *
 * Nodes of the wrong order make a cell zigzag, so that the positions of points decide: how much lines of nodes through the
 * cells bend is measured in both orders, and the file's version counts only where that does not tell.
 *
 * Returns what a person should know, empty if all is as declared.
 */
std::string unify_node_order(std::span<const double> points, std::span<std::int64_t> connectivity, std::span<const Cell> cells,
                             std::vector<CellKind>& kinds, bool declares_old_hexahedra);

} // namespace elvis_vtk
