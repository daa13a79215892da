#include "hdf_grid.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace elvis_vtk {

namespace {

/** Numbers of points and ids beyond this are damage: sums of them stay far from an overflow. */
constexpr std::uint64_t most = std::uint64_t(1) << 46;

std::vector<std::uint64_t> read_all(const elvis::hdf5::File& file, const std::string& name) {
    const elvis::hdf5::Dataset dataset = file.dataset(name);
    const std::vector<std::uint64_t> shape = dataset.shape();
    // Offsets of connectivity have a column for each kind of cells of PolyData; grids have one.
    if (shape.empty() || shape.size() > 2 || (shape.size() == 2 && shape[1] != 1)) {
        dataset.fail("is not a list");
    }
    std::vector<std::int64_t> numbers(shape[0]);
    dataset.read(std::vector<std::uint64_t>(shape.size(), 0), shape, std::span(numbers));
    for (const std::int64_t number : numbers) {
        if (number < 0 || static_cast<std::uint64_t>(number) > most) {
            dataset.fail("holds " + std::to_string(number) + ", not a number of things");
        }
    }
    return {numbers.begin(), numbers.end()};
}

std::string type_of(const elvis::hdf5::File& file, const std::string& group) {
    if (!file.has_attribute(group, "Type")) {
        return {};
    }
    const std::vector<std::string> texts = file.texts_of_attribute(group, "Type");
    return texts.empty() ? std::string() : texts.front();
}

void check_version(const elvis::hdf5::File& file) {
    const std::vector<double> version = file.numbers_of_attribute("VTKHDF", "Version");
    if (version.size() != 2) {
        file.fail("VTKHDF@Version", "is not two numbers");
    }
    if (version[0] != 1 && version[0] != 2) {
        file.fail("VTKHDF@Version", "is " + std::to_string(static_cast<int>(version[0])) + "." +
                                        std::to_string(static_cast<int>(version[1])) + "; 1 and 2 are read");
    }
}

} // namespace

HdfGrid::HdfGrid(const elvis::hdf5::File& file, std::string group) : m_file(file), m_group(std::move(group)) {
    m_n_points = counts("NumberOfPoints");
    m_n_cells = counts("NumberOfCells");
    m_n_ids = counts("NumberOfConnectivityIds");
    if (m_n_cells.size() != m_n_points.size() || m_n_ids.size() != m_n_points.size()) {
        m_file.fail(m_group, "has NumberOfPoints, NumberOfCells and NumberOfConnectivityIds of " +
                                 std::to_string(m_n_points.size()) + ", " + std::to_string(m_n_cells.size()) + " and " +
                                 std::to_string(m_n_ids.size()) + " parts");
    }
    m_has_steps = m_file.has(name("Steps"));
    read_steps();
}

void HdfGrid::read_steps() {
    const std::size_t n_parts = m_n_points.size();
    if (!m_has_steps) {
        m_n_parts = {n_parts};
        m_first_part = m_first_point = m_first_cell = m_first_id = {0};
        return;
    }
    const elvis::hdf5::Dataset values = m_file.dataset(name("Steps/Values"));
    if (values.shape().size() != 1 || values.shape()[0] == 0) {
        values.fail("is not a list of times");
    }
    m_times.resize(values.shape()[0]);
    values.read({0}, {m_times.size()}, std::span(m_times));
    m_first_part = offsets("PartOffsets");
    m_first_point = offsets("PointOffsets");
    m_first_cell = offsets("CellOffsets");
    m_first_id = offsets("ConnectivityIdOffsets");
    if (m_file.has(name("Steps/NumberOfParts"))) {
        m_n_parts = offsets("NumberOfParts");
    } else {
        m_n_parts.assign(n_steps(), std::max<std::size_t>(1, n_parts / n_steps()));
    }
    for (std::size_t step = 0; step < n_steps(); ++step) {
        if (m_first_part[step] > n_parts || m_n_parts[step] > n_parts - m_first_part[step]) {
            m_file.fail(name("Steps"), "step " + std::to_string(step) + " has " + std::to_string(m_n_parts[step]) +
                                           " parts from part " + std::to_string(m_first_part[step]) + " on, of " +
                                           std::to_string(n_parts) + " in the file");
        }
    }
}

std::optional<double> HdfGrid::time_value() const {
    const std::string full = name("FieldData/TimeValue");
    if (!m_file.has(full)) {
        return std::nullopt;
    }
    const elvis::hdf5::Dataset dataset = m_file.dataset(full);
    const std::vector<std::uint64_t>& shape = dataset.shape();
    if (!dataset.holds_numbers() || std::ranges::any_of(shape, [](std::uint64_t extent) { return extent != 1; })) {
        return std::nullopt;
    }
    double time = 0;
    dataset.read(std::vector<std::uint64_t>(shape.size(), 0), shape, std::span(&time, 1));
    return time;
}

std::vector<HdfPart> HdfGrid::parts(std::size_t step) const {
    std::vector<HdfPart> parts;
    HdfPart part;
    part.first_point = m_first_point[step];
    part.first_cell = m_first_cell[step];
    part.first_id = m_first_id[step];
    // Each part has an entry more than cells.
    part.first_offset = m_first_cell[step] + m_first_part[step];
    for (std::uint64_t index = m_first_part[step]; index < m_first_part[step] + m_n_parts[step]; ++index) {
        part.n_points = m_n_points[index];
        part.n_cells = m_n_cells[index];
        part.n_ids = m_n_ids[index];
        parts.push_back(part);
        part.first_point += part.n_points;
        part.first_cell += part.n_cells;
        part.first_id += part.n_ids;
        part.first_offset += part.n_cells + 1;
        part.points_before += part.n_points;
        part.cells_before += part.n_cells;
        if (std::max({part.first_point, part.first_cell, part.first_id}) > 2 * most) {
            m_file.fail(m_group, "announces more points, cells or ids than is possible");
        }
    }
    return parts;
}

std::uint64_t HdfGrid::first_row(std::size_t step, const std::string& data, const std::string& array) const {
    if (!m_has_steps) {
        return 0;
    }
    const std::string of_array = data + "Offsets/" + array;
    if (m_file.has(name("Steps/" + of_array))) {
        return offsets(of_array)[step];
    }
    return (data == "PointData" ? m_first_point : m_first_cell)[step];
}

std::vector<std::uint64_t> HdfGrid::mesh_key(std::size_t step) const {
    return {m_first_part[step], m_n_parts[step], m_first_point[step], m_first_cell[step], m_first_id[step]};
}

std::vector<std::uint64_t> HdfGrid::counts(const std::string& list) const { return read_all(m_file, name(list)); }

std::vector<std::uint64_t> HdfGrid::offsets(const std::string& list) const {
    const std::string full = name("Steps/" + list);
    std::vector<std::uint64_t> read = read_all(m_file, full);
    if (read.size() < n_steps()) {
        m_file.fail(full, "has " + std::to_string(read.size()) + " entries for " + std::to_string(n_steps()) + " time steps");
    }
    return read;
}

std::vector<HdfGrid> hdf_grids(const elvis::hdf5::File& file) {
    if (!file.has("VTKHDF")) {
        file.fail("", "has no group VTKHDF");
    }
    check_version(file);
    const std::string type = type_of(file, "VTKHDF");
    std::vector<HdfGrid> grids;
    if (type == "UnstructuredGrid") {
        grids.emplace_back(file, "VTKHDF");
        return grids;
    }
    if (type != "PartitionedDataSetCollection" && type != "MultiBlockDataSet") {
        file.fail("VTKHDF", "is of type '" + type + "'; UnstructuredGrid and collections of it are read");
    }
    for (const std::string& name : file.names("VTKHDF")) {
        const std::string block = "VTKHDF/" + name;
        if (name == "Assembly") {
            continue;
        }
        const std::string of_block = type_of(file, block);
        if (of_block != "UnstructuredGrid") {
            file.fail(block, "is of type '" + of_block + "'; of a collection's data sets, UnstructuredGrid is read");
        }
        grids.emplace_back(file, block);
        if (grids.back().times() != grids.front().times()) {
            file.fail(block, "has other time steps than the data sets before it");
        }
    }
    if (grids.empty()) {
        file.fail("VTKHDF", "is a collection of no data sets");
    }
    return grids;
}

std::uint32_t probe_hdf(const char* path) {
    if (!elvis::hdf5::is_hdf5(path)) {
        return 0;
    }
    try {
        return elvis::hdf5::File(path).has("VTKHDF") ? 100 : 0;
    } catch (const elvis::api::Error&) {
        return 0;
    }
}

} // namespace elvis_vtk
