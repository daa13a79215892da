#include "data_set.hpp"

#include <algorithm>

namespace elvis_vtk {

namespace {

/** Whether any point belongs to two cells. */
bool shares_points(const Grid& grid) {
    std::vector<bool> is_used(grid.points.size() / 3);
    for (const Cell& cell : grid.cells) {
        for (std::size_t node = 0; node < n_nodes(grid.kinds[cell.kind]); ++node) {
            const auto point = static_cast<std::size_t>(grid.connectivity[cell.first + node]);
            if (is_used[point]) {
                return true;
            }
            is_used[point] = true;
        }
    }
    return false;
}

bool is_same_mesh(const Grid& a, const Grid& b) {
    return a.points == b.points && a.connectivity == b.connectivity && a.kinds == b.kinds && a.weights == b.weights &&
           a.n_source_cells == b.n_source_cells && std::ranges::equal(a.cells, b.cells, [](const Cell& x, const Cell& y) {
               return x.first == y.first && x.kind == y.kind && x.source == y.source;
           });
}

} // namespace

DataSet::DataSet(const std::vector<std::string>& paths, const elvis::api::Host& host) : m_steps(find_time_steps(paths)) {
    for (std::size_t index = 0; index < m_steps.size(); ++index) {
        host.check_cancelled();
        host.report_progress(static_cast<double>(index) / static_cast<double>(m_steps.size()), "reading files");
        const TimeStep& step = m_steps[index];
        std::optional<double> time = step.time;
        if (index == 0 || !have_same_mesh(m_steps[0], step)) {
            Grid grid = read_grid(step, host);
            time = time ? time : grid.time;
            m_mantissa_bits = std::min(m_mantissa_bits, grid.mantissa_bits);
            if (index == 0) {
                m_mesh = std::move(grid);
                set_fields();
            } else {
                check_step(grid, step.files.front());
            }
        }
        // Files without any time are counted.
        m_times.push_back(time.value_or(static_cast<double>(index)));
    }
    m_has_shared_points = shares_points(m_mesh);
}

void DataSet::set_fields() {
    for (const FieldArray& array : m_mesh.point_arrays) {
        m_fields.push_back({array.name, array, false});
    }
    for (const FieldArray& array : m_mesh.cell_arrays) {
        const bool is_taken =
            std::ranges::find(m_mesh.point_arrays, array.name, &FieldArray::name) != m_mesh.point_arrays.end();
        m_fields.push_back({array.name + (is_taken ? " (cells)" : ""), array, true});
    }
}

void DataSet::check_step(const Grid& grid, const std::string& path) const {
    if (!is_same_mesh(m_mesh, grid)) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                "the mesh is not that of the first time step; only data sets on one mesh are read, so "
                                "convert such steps one by one");
    }
    for (const SourceField& field : m_fields) {
        const std::vector<FieldArray>& arrays = field.is_of_cells ? grid.cell_arrays : grid.point_arrays;
        const auto found = std::ranges::find(arrays, field.array.name, &FieldArray::name);
        if (found == arrays.end() || found->n_components != field.array.n_components) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                    "field '" + field.name +
                                        "' of the first time step is missing or has another number of components");
        }
    }
}

std::shared_ptr<const StepValues> DataSet::values(std::size_t step) const {
    const std::lock_guard lock(m_mutex);
    if (!m_held || m_held_step != step) {
        // The step before goes first, so that there are never two.
        m_held.reset();
        m_held = std::make_shared<StepValues>(read_values(m_steps[step], m_mesh, m_fields));
        m_held_step = step;
    }
    return m_held;
}

} // namespace elvis_vtk
