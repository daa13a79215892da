/**
 * @file grid_curve.hpp
 * The order in which MFEM numbers the cells of a Cartesian grid of squares or cubes: a Hilbert curve generalized to any counts.
 */
#pragma once

#include <array>
#include <vector>

namespace elvis_mfem {

/** A cell, or a vector between cells; the third is 0 in the plane. */
using Cell = std::array<int, 3>;

/** All cells of a grid along the curve. In the plane the third count is 0, and the curve is another than that of one layer. */
std::vector<Cell> curve_through_grid(const std::array<int, 3>& counts);

} // namespace elvis_mfem
