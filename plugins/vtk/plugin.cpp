/**
 * @file plugin.cpp
 * Conversion plugin for VTK's unstructured grids: XML files and VTKHDF.
 */
#include "cell/basis_cache.hpp"
#include "data_set.hpp"
#include "file/hdf_grid.hpp"
#include "file/xml_file.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>

namespace {

using elvis_vtk::BasisCache;
using elvis_vtk::BasisTable;
using elvis_vtk::Cell;
using elvis_vtk::CellKind;
using elvis_vtk::DataSet;
using elvis_vtk::Grid;
using elvis_vtk::SourceField;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return std::max(elvis_vtk::probe(path), elvis_vtk::probe_hdf(path)); }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(host), m_data(paths, host), m_bases(m_data.mesh().kinds) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        for (const SourceField& field : m_data.fields()) {
            m_n_values += field.array.n_components;
        }
    }

    void get_info(elvis_source_info& info) override {
        const Grid& mesh = m_data.mesh();
        info.dimension = static_cast<std::uint32_t>(mesh.dimension());
        info.n_elements = mesh.cells.size();
        info.n_corner_ids = has_corner_ids() ? mesh.points.size() / 3 : 0;
        info.n_fields = static_cast<std::uint32_t>(m_data.fields().size());
        info.n_time_steps = static_cast<std::uint32_t>(m_data.times().size());
        info.mantissa_bits = m_data.mantissa_bits();
        if (!has_corner_ids() && info.mantissa_bits < 40) {
            // Copies of a corner may be rounded differently: by some units in the last place of the largest coordinate.
            double largest = 0;
            for (const double coordinate : mesh.points) {
                largest = std::max(largest, std::isfinite(coordinate) ? std::abs(coordinate) : 0);
            }
            info.corner_tolerance = std::ldexp(largest, 2 - static_cast<int>(info.mantissa_bits));
        }
    }

    void get_field(std::uint32_t index, elvis_source_field& out) override {
        const SourceField& field = m_data.fields()[index];
        out.n_components = field.array.n_components;
        out.name = field.name.c_str();
        // Where every cell has its own points the file does not tell; the jumps will.
        out.continuity = field.is_of_cells            ? ELVIS_CONTINUITY_DISCONTINUOUS
                         : m_data.has_shared_points() ? ELVIS_CONTINUITY_CONTINUOUS
                                                      : ELVIS_CONTINUITY_UNKNOWN;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        const Grid& mesh = m_data.mesh();
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            const Cell& cell = mesh.cells[first + index];
            const CellKind& kind = mesh.kinds[cell.kind];
            elvis_source_element element{};
            element.shape = kind.shape;
            const std::array<std::uint32_t, 3> order = native_order(kind);
            std::copy(order.begin(), order.end(), element.geometry_order);
            const std::array<std::uint8_t, 8> corners = corner_nodes(kind);
            constexpr std::size_t n_corners[] = {8, 6, 5, 4, 4, 3};
            for (std::size_t corner = 0; corner < n_corners[kind.shape]; ++corner) {
                element.corners[corner] = mesh.connectivity[cell.first + corners[corner]];
            }
            std::fill_n(element.face_groups, 6, ELVIS_GROUP_NONE);
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        const Grid& mesh = m_data.mesh();
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            elvis_source_space space{};
            space.is_contained = 1;
            if (!m_data.fields()[field].is_of_cells) {
                const CellKind& kind = mesh.kinds[mesh.cells[first + index].kind];
                const std::array<std::uint32_t, 3> order = native_order(kind);
                std::copy(order.begin(), order.end(), space.order);
                // Values between nodes that are elsewhere would be wrong.
                space.is_contained = kind.is_rational || mesh.has_unclear_nodes ? 0 : 1;
            }
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const Grid& mesh = m_data.mesh();
        const Cell& cell = mesh.cells[element];
        const std::shared_ptr<const BasisTable> table = m_bases.table(cell.kind, xi);
        const std::vector<double> denominators = denominator(cell, *table);
        std::vector<double> sums(table->n_points);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sum(cell, *table, mesh.points, 3, axis, denominators, sums);
            for (std::size_t point = 0; point < table->n_points; ++point) {
                positions[3 * point + axis] = sums[point];
            }
        }
    }

    void sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi, double* values) override {
        const Cell& cell = m_data.mesh().cells[element];
        const std::size_t n_points = xi.size() / 3;
        const std::shared_ptr<const BasisTable> table = m_bases.table(cell.kind, xi);
        const std::vector<double> denominators = denominator(cell, *table);
        const std::shared_ptr<const elvis_vtk::StepValues> step = m_data.values(time_step);
        std::vector<double> sums(n_points);
        std::size_t at = 0;
        for (std::size_t index = 0; index < m_data.fields().size(); ++index) {
            const SourceField& field = m_data.fields()[index];
            const std::vector<double>& numbers = (*step)[index];
            const std::size_t n_components = field.array.n_components;
            for (std::size_t component = 0; component < n_components; ++component, ++at) {
                if (field.is_of_cells) {
                    std::ranges::fill(sums, numbers[element * n_components + component]);
                } else {
                    sum(cell, *table, numbers, n_components, component, denominators, sums);
                }
                for (std::size_t point = 0; point < n_points; ++point) {
                    values[point * m_n_values + at] = sums[point];
                }
            }
        }
    }

    double get_time(std::uint32_t time_step) { return m_data.times()[time_step]; }

private:
    /** Points are shared within pieces only; across pieces, and where cells share none, corners are matched by position. */
    bool has_corner_ids() const { return m_data.has_shared_points() && m_data.mesh().n_pieces == 1; }

    /** Sum of weighted functions at each point; empty for cells that are not rational. */
    std::vector<double> denominator(const Cell& cell, const BasisTable& table) const {
        const Grid& mesh = m_data.mesh();
        if (!mesh.kinds[cell.kind].is_rational) {
            return {};
        }
        std::vector<double> sums(table.n_points, 0.0);
        for (std::size_t node = 0; node < m_bases.basis(cell.kind).size(); ++node) {
            const double weight = mesh.weights[static_cast<std::size_t>(mesh.connectivity[cell.first + node])];
            const double* const values = table.at(node);
            for (std::size_t point = 0; point < table.n_points; ++point) {
                sums[point] += weight * values[point];
            }
        }
        return sums;
    }

    /** One component of nodal numbers at all points of the table. */
    void sum(const Cell& cell, const BasisTable& table, const std::vector<double>& numbers, std::size_t stride,
             std::size_t component, const std::vector<double>& denominators, std::vector<double>& sums) const {
        const Grid& mesh = m_data.mesh();
        std::ranges::fill(sums, 0.0);
        for (std::size_t node = 0; node < m_bases.basis(cell.kind).size(); ++node) {
            const auto point_of_grid = static_cast<std::size_t>(mesh.connectivity[cell.first + node]);
            double coefficient = numbers[point_of_grid * stride + component];
            if (!denominators.empty()) {
                coefficient *= mesh.weights[point_of_grid];
            }
            const double* const values = table.at(node);
            for (std::size_t point = 0; point < table.n_points; ++point) {
                sums[point] += coefficient * values[point];
            }
        }
        for (std::size_t point = 0; point < denominators.size(); ++point) {
            sums[point] /= denominators[point];
        }
    }

    DataSet m_data;
    BasisCache m_bases;
    std::size_t m_n_values = 0;
};

} // namespace

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("VTK XML unstructured grid", ".vtu .pvtu"),
                                         elvis::api::file_format("ParaView time steps", ".pvd"),
                                         elvis::api::file_format("VTKHDF", ".vtkhdf .hdf")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.vtk", .name = "VTK reader", .version = "1.0.0", .vendor = "ElVis",
             .description = "Converts VTK's unstructured grids (.vtu, .pvtu, .pvd, .vtkhdf): linear, quadratic, Lagrange and "
                            "Bezier cells.",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table);
