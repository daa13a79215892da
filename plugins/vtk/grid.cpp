#include "grid.hpp"

#include "grid_pieces.hpp"

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
    for (Array& array : grid.cell_arrays) {
        std::size_t to = 0;
        for (std::size_t index = 0; index < grid.cells.size(); ++index) {
            for (std::size_t c = 0; c < array.n_components && is_volume(grid.cells[index]); ++c) {
                array.values[to++] = array.values[index * array.n_components + c];
            }
        }
        array.values.resize(to);
    }
    const std::size_t n_surfaces = grid.cells.size() - n_volumes;
    std::erase_if(grid.cells, [&](const Cell& cell) { return !is_volume(cell); });
    return n_surfaces;
}

} // namespace

Grid read_grid(const std::vector<std::string>& paths, const elvis::api::Host& host) {
    Grid grid;
    std::size_t n_left_out = 0;
    for (const std::string& path : paths) {
        const XmlFile file(path);
        if (file.type() != "UnstructuredGrid") {
            file.fail(file.root(), "type is '" + file.type() + "', not UnstructuredGrid");
        }
        n_left_out += add_pieces(file, grid, host);
    }
    n_left_out += remove_surfaces(grid);
    if (grid.cells.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, paths.empty() ? std::string() : paths.front(),
                                "holds no cells that are surfaces or volumes");
    }
    if (n_left_out > 0) {
        host.log(ELVIS_LOG_WARNING, paths.front() + ": " + std::to_string(n_left_out) +
                                        " cells of lower dimension (vertices, lines, surfaces beside volumes) are left out");
    }
    return grid;
}

} // namespace elvis_vtk
