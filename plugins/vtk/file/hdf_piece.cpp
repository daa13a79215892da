#include "hdf_piece.hpp"

#include <algorithm>

namespace elvis_vtk {

namespace {

using elvis::hdf5::Dataset;

const char* group_of(Section section) { return section == Section::point_data ? "PointData" : "CellData"; }

/** Rows of a dataset; a failure where they end before. */
template <class Number>
std::vector<Number> read_rows(const Dataset& dataset, std::uint64_t first, std::uint64_t count, std::uint64_t n_columns) {
    std::vector<std::uint64_t> shape = dataset.shape();
    if (shape.empty() || first > shape[0] || count > shape[0] - first) {
        dataset.fail("has " + std::to_string(shape.empty() ? 1 : shape[0]) + " rows; " + std::to_string(count) + " from row " +
                     std::to_string(first) + " on are expected");
    }
    std::vector<std::uint64_t> start(shape.size(), 0);
    start[0] = first;
    shape[0] = count;
    std::vector<Number> numbers(count * n_columns);
    dataset.read(start, shape, std::span(numbers));
    return numbers;
}

/** The text of an attribute; empty if there is none. */
std::string text_of(const elvis::hdf5::File& file, const std::string& object, const char* attribute) {
    if (!file.has_attribute(object, attribute)) {
        return {};
    }
    const std::vector<std::string> texts = file.texts_of_attribute(object, attribute);
    return texts.empty() ? std::string() : texts.front();
}

/** Columns of a dataset of rows, up to the most that a file of VTK may have. */
std::uint32_t n_columns(const Dataset& dataset) {
    const std::vector<std::uint64_t>& shape = dataset.shape();
    constexpr std::uint64_t most = 1024;
    std::uint64_t n = 1;
    for (std::size_t axis = 1; axis < shape.size(); ++axis) {
        n = shape[axis] > most ? most + 1 : std::min(most + 1, n * shape[axis]);
    }
    if (shape.empty() || n < 1 || n > most) {
        dataset.fail("has not 1 to 1024 components for each point or cell");
    }
    return static_cast<std::uint32_t>(n);
}

} // namespace

Numbers HdfPiece::points() const {
    const Dataset points = m_grid.file().dataset(m_grid.name("Points"));
    if (points.shape().size() != 2 || points.shape()[1] != 3) {
        points.fail("has not three coordinates a point");
    }
    return {read_rows<double>(points, m_part.first_point, m_part.n_points, 3), points.mantissa_bits({})};
}

PieceCells HdfPiece::cells() const {
    PieceCells cells;
    cells.connectivity = integers("Connectivity", m_part.first_id, m_part.n_ids);
    cells.types = integers("Types", m_part.first_cell, m_part.n_cells);
    cells.ends = integers("Offsets", m_part.first_offset, m_part.n_cells + 1);
    if (cells.ends.front() != 0) {
        m_grid.file().fail(m_grid.name("Offsets"), "begins a part with " + std::to_string(cells.ends.front()) +
                                                       " instead of 0, in row " + std::to_string(m_part.first_offset));
    }
    cells.ends.erase(cells.ends.begin());
    return cells;
}

std::vector<FieldArray> HdfPiece::arrays(Section section) const {
    const std::string group = m_grid.name(group_of(section));
    std::vector<FieldArray> found;
    if (!m_grid.file().has(group)) {
        return found;
    }
    for (const std::string& name : m_grid.file().names(group)) {
        const Dataset dataset = m_grid.file().dataset(group + "/" + name);
        if (dataset.holds_numbers()) {
            found.push_back({name, n_columns(dataset)});
        }
    }
    return found;
}

std::string HdfPiece::named_by(Section section, const char* attribute) const {
    const elvis::hdf5::File& file = m_grid.file();
    const std::string group = m_grid.name(group_of(section));
    if (!file.has(group)) {
        return {};
    }
    if (const std::string named = text_of(file, group, attribute); !named.empty()) {
        return named;
    }
    // Since version 2.6 arrays say themselves what they are.
    for (const std::string& name : file.names(group)) {
        if (text_of(file, group + "/" + name, "Attribute") == attribute) {
            return name;
        }
    }
    return {};
}

std::uint32_t HdfPiece::mantissa_bits(Section section, const FieldArray& array) const {
    return m_grid.file().dataset(m_grid.name(group_of(section)) + "/" + array.name).mantissa_bits({});
}

std::vector<double> HdfPiece::values(Section section, const FieldArray& array) const {
    const char* const group = group_of(section);
    const bool is_of_points = section == Section::point_data;
    const Dataset dataset = m_grid.file().dataset(m_grid.name(group) + "/" + array.name);
    if (n_columns(dataset) != array.n_components) {
        dataset.fail("has not " + std::to_string(array.n_components) + " components");
    }
    const std::uint64_t before = is_of_points ? m_part.points_before : m_part.cells_before;
    return read_rows<double>(dataset, m_grid.first_row(m_step, group, array.name) + before,
                             is_of_points ? m_part.n_points : m_part.n_cells, array.n_components);
}

void HdfPiece::fail(Section section, const std::string& what) const {
    constexpr const char* names[] = {"Points", "Connectivity", "PointData", "CellData"};
    m_grid.file().fail(m_grid.name(names[static_cast<std::size_t>(section)]), what);
}

std::vector<std::int64_t> HdfPiece::integers(const char* name, std::uint64_t first, std::uint64_t count) const {
    const Dataset dataset = m_grid.file().dataset(m_grid.name(name));
    if (dataset.shape().size() > 1 && n_columns(dataset) != 1) {
        dataset.fail("is not a list");
    }
    return read_rows<std::int64_t>(dataset, first, count, 1);
}

std::optional<double> visit_hdf_pieces(const std::string& path, std::size_t step,
                                       const std::function<void(const Piece&)>& visit) {
    const elvis::hdf5::File file(path);
    const std::vector<HdfGrid> grids = hdf_grids(file);
    for (const HdfGrid& grid : grids) {
        for (const HdfPart& part : grid.parts(step)) {
            if (part.n_cells > 0) {
                visit(HdfPiece(grid, step, part));
            }
        }
    }
    return grids.front().time_value();
}

} // namespace elvis_vtk
