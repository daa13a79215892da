#include "grid.hpp"

#include "cell/node_spacing.hpp"
#include "grid_piece.hpp"

#include <algorithm>

namespace elvis_vtk {

namespace {

/** Where there are volumes, surfaces go; their number is returned. */
std::size_t remove_surfaces(Grid& grid) {
    const auto is_volume = [&](const Cell& cell) { return dimension(grid.kinds[cell.kind]) == 3; };
    const auto n_volumes = static_cast<std::size_t>(std::ranges::count_if(grid.cells, is_volume));
    if (n_volumes == 0 || n_volumes == grid.cells.size()) {
        return 0;
    }
    const std::size_t n_surfaces = grid.cells.size() - n_volumes;
    std::erase_if(grid.cells, [&](const Cell& cell) { return !is_volume(cell); });
    return n_surfaces;
}

/** Values of the grid's cells, from those of all cells that the pieces have. */
void keep_cells(const Grid& grid, std::size_t n_components, std::vector<double>& values) {
    if (grid.cells.size() == grid.n_source_cells) {
        return;
    }
    // Sources ascend: values move to the front.
    auto to = values.begin();
    for (const Cell& cell : grid.cells) {
        to = std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(cell.source * n_components), n_components, to);
    }
    values.erase(to, values.end());
}

} // namespace

Grid read_grid(const TimeStep& step, const elvis::api::Host& host) {
    Grid grid;
    std::size_t n_left_out = 0;
    const std::string path = step.files.empty() ? std::string() : step.files.front();
    grid.time = visit_pieces(step, [&](const Piece& piece) {
        host.check_cancelled();
        n_left_out += add_piece(piece, grid, host);
    });
    n_left_out += remove_surfaces(grid);
    if (grid.cells.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "holds no cells that are surfaces or volumes");
    }
    if (n_left_out > 0) {
        host.log(ELVIS_LOG_WARNING, path + ": " + std::to_string(n_left_out) +
                                        " cells of lower dimension (vertices, lines, surfaces beside volumes) are left out");
    }
    adopt_node_spacing(grid, path, host);
    return grid;
}

StepValues read_values(const TimeStep& step, const Grid& grid, const std::vector<SourceField>& fields) {
    StepValues values(fields.size());
    visit_pieces(step, [&](const Piece& piece) {
        for (std::size_t index = 0; index < fields.size(); ++index) {
            const SourceField& field = fields[index];
            append(values[index], piece.values(field.is_of_cells ? Section::cell_data : Section::point_data, field.array));
        }
    });
    for (std::size_t index = 0; index < fields.size(); ++index) {
        const SourceField& field = fields[index];
        const std::size_t n = field.array.n_components;
        if (values[index].size() != n * (field.is_of_cells ? grid.n_source_cells : grid.points.size() / 3)) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, step.files.front(),
                                    "has " + std::to_string(values[index].size() / n) + " values of '" + field.name +
                                        "', other than when it was opened");
        }
        if (field.is_of_cells) {
            keep_cells(grid, n, values[index]);
        }
    }
    return values;
}

} // namespace elvis_vtk
