/**
 * @file grid_fields.hpp
 * Which arrays of a piece are fields.
 */
#pragma once

#include "grid.hpp"

namespace elvis_vtk {

/** Adds a piece's arrays to those of the grid, which all pieces have: others are left out with a warning. */
void add_fields(const Piece& piece, Section section, Grid& grid, const elvis::api::Host& host);

} // namespace elvis_vtk
