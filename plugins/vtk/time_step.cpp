#include "time_step.hpp"

#include "file/hdf_piece.hpp"
#include "file/xml_piece.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

namespace elvis_vtk {

namespace {

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
void add_files(const std::string& path, TimeStep& step) {
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
std::vector<TimeStep> read_collection(const XmlFile& file) {
    std::map<double, TimeStep> steps;
    const pugi::xml_node collection = file.child(file.root(), "Collection");
    for (const pugi::xml_node node : collection.children("DataSet")) {
        const double time = node.attribute("timestep").as_double();
        TimeStep& step = steps[time];
        step.time = time;
        add_files(referred(file, node, "file"), step);
    }
    if (steps.empty()) {
        file.fail(collection, "has no element DataSet");
    }
    std::vector<TimeStep> sorted;
    for (auto& [time, step] : steps) {
        sorted.push_back(std::move(step));
    }
    return sorted;
}

std::vector<TimeStep> steps_of_hdf(const std::string& path) {
    const elvis::hdf5::File file(path);
    const std::vector<HdfGrid> grids = hdf_grids(file);
    std::vector<TimeStep> steps;
    for (std::size_t index = 0; index < grids.front().n_steps(); ++index) {
        TimeStep& step = steps.emplace_back();
        if (!grids.front().times().empty()) {
            step.time = grids.front().times()[index];
        }
        step.files = {path};
        step.index_in_file = index;
        for (const HdfGrid& grid : grids) {
            const std::vector<std::uint64_t> key = grid.mesh_key(index);
            step.mesh_key.insert(step.mesh_key.end(), key.begin(), key.end());
        }
    }
    std::ranges::stable_sort(steps, {}, &TimeStep::time);
    return steps;
}

std::vector<TimeStep> steps_of_xml(const std::string& path) {
    {
        const XmlFile file(path);
        if (file.type() == "Collection") {
            return read_collection(file);
        }
    }
    std::vector<TimeStep> steps(1);
    add_files(path, steps.front());
    return steps;
}

} // namespace

std::vector<TimeStep> find_time_steps(const std::vector<std::string>& paths) {
    std::vector<TimeStep> steps;
    for (const std::string& path : paths) {
        std::ranges::move(elvis::hdf5::is_hdf5(path) ? steps_of_hdf(path) : steps_of_xml(path), std::back_inserter(steps));
    }
    return steps;
}

bool have_same_mesh(const TimeStep& a, const TimeStep& b) {
    return !a.mesh_key.empty() && a.files == b.files && a.mesh_key == b.mesh_key;
}

std::optional<double> visit_pieces(const TimeStep& step, const std::function<void(const Piece&)>& visit) {
    std::optional<double> time;
    for (const std::string& path : step.files) {
        const std::optional<double> of_file =
            elvis::hdf5::is_hdf5(path) ? visit_hdf_pieces(path, step.index_in_file, visit) : visit_xml_pieces(path, visit);
        time = of_file ? of_file : time;
    }
    return time;
}

} // namespace elvis_vtk
