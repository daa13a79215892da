/**
 * @file grid.hpp
 * The unstructured grid of one .vtu file or of several that are its pieces.
 */
#pragma once

#include "cell_connectivity.hpp"
#include "xml_file.hpp"

#include <optional>

namespace elvis_vtk {

/** Values at points or of cells, component by component of each in turn. */
struct Array {
    std::string name;
    std::uint32_t n_components = 1;
    std::vector<double> values;
};

struct Grid {
    /** x, y, z each. */
    std::vector<double> points;
    std::vector<std::int64_t> connectivity;
    std::vector<Cell> cells;
    std::vector<CellKind> kinds;
    /** Weights of Bezier cells, one a point; empty if there are none. */
    std::vector<double> weights;
    std::vector<Array> point_arrays;
    std::vector<Array> cell_arrays;
    std::uint32_t mantissa_bits = 53;
    /** TimeValue among the field data. */
    std::optional<double> time;
    /** Pieces with cells. Points are shared within a piece only. */
    std::size_t n_pieces = 0;

    int dimension() const { return cells.empty() ? 3 : elvis_vtk::dimension(kinds[cells.front().kind]); }
};

/**
 * Reads the files one after the other into one grid. Ghost cells are left out, and so are lines and vertices, and surfaces
 * where there are volumes; what was left out and other remarks are logged.
 */
Grid read_grid(const std::vector<std::string>& paths, const elvis::api::Host& host);

} // namespace elvis_vtk
