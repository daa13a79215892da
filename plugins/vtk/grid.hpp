/**
 * @file grid.hpp
 * The unstructured grid of a time step: the pieces of one or several files, put together.
 */
#pragma once

#include "cell/cell_connectivity.hpp"
#include "file/piece.hpp"
#include "time_step.hpp"

#include <elvis/plugin.hpp>

namespace elvis_vtk {

/** An array that is a field. */
struct SourceField {
    /** Of its own among all fields. */
    std::string name;
    FieldArray array;
    bool is_of_cells = false;
};

/** Values of all fields at one time step: of points or cells, as the field says. */
using StepValues = std::vector<std::vector<double>>;

struct Grid {
    /** x, y, z each. */
    std::vector<double> points;
    std::vector<std::int64_t> connectivity;
    std::vector<Cell> cells;
    std::vector<CellKind> kinds;
    /** Weights of Bezier cells, one a point; empty if there are none. */
    std::vector<double> weights;
    /** That all pieces have. */
    std::vector<FieldArray> point_arrays;
    std::vector<FieldArray> cell_arrays;
    std::uint32_t mantissa_bits = 53;
    /** TimeValue among the field data. */
    std::optional<double> time;
    /** Whether edges disagree about the nodes of Lagrange cells (node_spacing.hpp). */
    bool has_unclear_nodes = false;
    /** Pieces with cells. Points are shared within a piece only. */
    std::size_t n_pieces = 0;
    /** Cells of all pieces, those counted that are left out. */
    std::size_t n_source_cells = 0;

    int dimension() const { return cells.empty() ? 3 : elvis_vtk::dimension(kinds[cells.front().kind]); }
};

/**
 * Reads the pieces of a time step one after the other into one grid, without values of fields. Ghost cells are left out, and so
 * are lines and vertices, and surfaces where there are volumes; what was left out and other remarks are logged.
 */
Grid read_grid(const TimeStep& step, const elvis::api::Host& host);

/** Values of fields on such a grid, which is that of the step: each at all points, or of all cells. */
StepValues read_values(const TimeStep& step, const Grid& grid, const std::vector<SourceField>& fields);

} // namespace elvis_vtk
