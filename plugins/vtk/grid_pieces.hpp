/**
 * @file grid_pieces.hpp
 * The pieces of one .vtu file.
 */
#pragma once

#include "grid.hpp"

namespace elvis_vtk {

/** Adds a file's pieces to a grid. Ghost cells are left out, and so are lines and vertices, whose number is returned. */
std::size_t add_pieces(const XmlFile& file, Grid& grid, const elvis::api::Host& host);

} // namespace elvis_vtk
