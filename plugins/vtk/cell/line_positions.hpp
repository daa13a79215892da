/**
 * @file line_positions.hpp
 * Where nodes lie along the lines of a Lagrange cell.
 */
#pragma once

#include <span>

namespace elvis_vtk {

/** Equidistant is what VTK means; solvers write nodes of their own as well. */
enum class Spacing { equidistant, lobatto, chebyshev };

/** The nodes of a degree from 1 to max_degree, in [0,1], ascending. */
std::span<const double> line_positions(Spacing spacing, int degree);

} // namespace elvis_vtk
