#include "data_set.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

namespace elvis_vtk {

namespace {

/** Files of one time step. */
struct Step {
    std::optional<double> time;
    std::vector<std::string> files;
};

std::string beside(const std::string& path, const char* name) {
    return (std::filesystem::path(path).parent_path() / name).string();
}

/** A referred file, by an attribute that must be there. */
std::string referred(const XmlFile& file, pugi::xml_node node, const char* attribute) {
    const char* const name = node.attribute(attribute).as_string();
    if (*name == '\0') {
        file.fail(node, "has no attribute " + std::string(attribute));
    }
    return beside(file.path(), name);
}

/** Adds a .vtu, or the pieces of a .pvtu, to a step. */
void add_files(const std::string& path, Step& step) {
    const XmlFile file(path);
    if (file.type() == "UnstructuredGrid") {
        step.files.push_back(path);
        return;
    }
    if (file.type() != "PUnstructuredGrid") {
        file.fail(file.root(), "type is '" + file.type() + "'; UnstructuredGrid and PUnstructuredGrid are read here");
    }
    const pugi::xml_node grid = file.child(file.root(), "PUnstructuredGrid");
    for (const pugi::xml_node piece : grid.children("Piece")) {
        step.files.push_back(referred(file, piece, "Source"));
    }
    if (step.files.empty()) {
        file.fail(grid, "has no element Piece");
    }
}

/** The steps of a collection by time; data sets of one time are pieces of one step. */
std::vector<Step> read_collection(const XmlFile& file) {
    std::map<double, Step> steps;
    const pugi::xml_node collection = file.child(file.root(), "Collection");
    for (const pugi::xml_node node : collection.children("DataSet")) {
        const double time = node.attribute("timestep").as_double();
        Step& step = steps[time];
        step.time = time;
        add_files(referred(file, node, "file"), step);
    }
    if (steps.empty()) {
        file.fail(collection, "has no element DataSet");
    }
    std::vector<Step> sorted;
    for (auto& [time, step] : steps) {
        sorted.push_back(std::move(step));
    }
    return sorted;
}

std::vector<Step> steps_of(const std::vector<std::string>& paths) {
    std::vector<Step> steps;
    for (const std::string& path : paths) {
        bool is_collection = false;
        {
            const XmlFile file(path);
            is_collection = file.type() == "Collection";
            if (is_collection) {
                std::ranges::move(read_collection(file), std::back_inserter(steps));
            }
        }
        if (!is_collection) {
            add_files(path, steps.emplace_back());
        }
    }
    return steps;
}

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
           std::ranges::equal(a.cells, b.cells,
                              [](const Cell& x, const Cell& y) { return x.first == y.first && x.kind == y.kind; });
}

} // namespace

DataSet::DataSet(const std::vector<std::string>& paths, const elvis::api::Host& host) {
    const std::vector<Step> steps = steps_of(paths);
    for (std::size_t index = 0; index < steps.size(); ++index) {
        host.check_cancelled();
        host.report_progress(static_cast<double>(index) / static_cast<double>(steps.size()), "reading files");
        Grid grid = read_grid(steps[index].files, host);
        // Files without any time are counted.
        m_times.push_back(steps[index].time.value_or(grid.time.value_or(static_cast<double>(index))));
        add_step(std::move(grid), steps[index].files.front());
    }
    m_has_shared_points = shares_points(m_mesh);
}

void DataSet::add_step(Grid&& grid, const std::string& path) {
    std::vector<Array> arrays;
    const auto move_to = [&](std::vector<Array>& from, bool is_of_cells) {
        for (Array& array : from) {
            SourceField field{array.name, array.n_components, is_of_cells};
            if (is_of_cells && std::ranges::find(arrays, array.name, &Array::name) != arrays.end()) {
                field.name = array.name + " (cells)";
            }
            if (m_values.empty()) {
                m_fields.push_back(field);
            }
            arrays.push_back({field.name, array.n_components, std::move(array.values)});
        }
        from.clear();
    };
    const bool is_first = m_values.empty();
    move_to(grid.point_arrays, false);
    move_to(grid.cell_arrays, true);
    m_mantissa_bits = std::min(m_mantissa_bits, grid.mantissa_bits);
    if (is_first) {
        m_mesh = std::move(grid);
    } else if (!is_same_mesh(m_mesh, grid)) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                "the mesh is not that of the first time step; only data sets on one mesh are read, so "
                                "convert such steps one by one");
    }
    auto& values = m_values.emplace_back();
    for (const SourceField& field : m_fields) {
        const auto found = std::ranges::find(arrays, field.name, &Array::name);
        if (found == arrays.end() || found->n_components != field.n_components) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                    "field '" + field.name +
                                        "' of the first time step is missing or has another number of "
                                        "components");
        }
        values.push_back(std::move(found->values));
    }
}

} // namespace elvis_vtk
