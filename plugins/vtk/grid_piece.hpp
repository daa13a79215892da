/**
 * @file grid_piece.hpp
 * A piece becomes a part of a grid.
 */
#pragma once

#include "grid.hpp"

namespace elvis_vtk {

/** Adds a piece to a grid. Ghost cells are left out, and so are lines and vertices, whose number is returned. */
std::size_t add_piece(const Piece& piece, Grid& grid, const elvis::api::Host& host);

} // namespace elvis_vtk
