/**
 * @file node_order.hpp
 * The order in which VTK (9.1 and later) numbers the nodes of Lagrange and Bezier cells. format.md gives it in prose.
 */
#pragma once

#include "cell_kind.hpp"

#include <array>
#include <vector>

namespace elvis_vtk {

/** Steps along r, s and t from the cell's first corner; a step is one over the degree. */
using LatticePoint = std::array<int, 3>;

std::vector<LatticePoint> triangle_nodes(int degree);
std::vector<LatticePoint> quadrilateral_nodes(int degree_r, int degree_s);
std::vector<LatticePoint> tetrahedron_nodes(int degree);
std::vector<LatticePoint> hexahedron_nodes(int degree_r, int degree_s, int degree_t);
/** `degree` in the triangle, `degree_t` along the prism. */
std::vector<LatticePoint> wedge_nodes(int degree, int degree_t);

/** Of families tensor, simplex and wedge; empty for others. */
std::vector<LatticePoint> lattice_nodes(const CellKind& kind);

} // namespace elvis_vtk
