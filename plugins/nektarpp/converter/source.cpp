/*
 * Nektar++ meshes and fields for conversion: evaluated where the host asks.
 */
#include "source.hpp"

#include "../reader/field/field_series.hpp"
#include "../reader/geometry/mesh.hpp"
#include "../reader/text/paths.hpp"
#include "basis_cache.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <limits>

namespace nektarpp {

namespace {

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return is_nektar(path) ? 100 : 0; }

    Source(const elvis::api::Host& table, const std::vector<std::string>& paths, const std::string& options)
        : Source(table, read(paths, options)) {}

    void get_info(elvis_source_info& info) override {
        info.dimension = static_cast<std::uint32_t>(m_mesh.dimension());
        info.n_elements = m_mesh.elements().size();
        info.n_corner_ids = m_mesh.n_vertices();
        info.n_fields = static_cast<std::uint32_t>(m_series.fields().size());
        info.n_time_steps = static_cast<std::uint32_t>(std::max<std::size_t>(1, m_series.n_steps()));
        info.n_boundary_groups = static_cast<std::uint32_t>(m_mesh.groups().size());
        info.mantissa_bits = 53;
    }

    void get_field(std::uint32_t field, elvis_source_field& out) override {
        out.n_components = 1;
        out.name = m_series.fields().at(field).c_str();
        // The file does not say whether the solver was continuous.
        out.continuity = ELVIS_CONTINUITY_UNKNOWN;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            const MeshElement& source = m_mesh.elements()[first + index];
            elvis_source_element element{};
            element.shape = static_cast<elvis_shape>(source.shape);
            std::ranges::copy(target_order(Mesh::mapping_modes(source)), element.geometry_order);
            std::ranges::copy(source.corners, element.corners);
            std::ranges::copy(source.groups, element.face_groups);
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            out.set(index, m_series.space(field, first + index));
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const MeshElement& source = m_mesh.elements()[element];
        std::vector<double> coefficients;
        m_mesh.mapping_coefficients(source, coefficients);
        const auto values = m_cache.values(Mesh::mapping_modes(source), xi);
        const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3>> modes(coefficients.data(), values->cols(), 3);
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(positions.data(), values->rows(), 3).noalias() =
            *values * modes;
    }

    void sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi, double* values) override {
        if (m_series.fields().empty()) {
            return;
        }
        const std::shared_ptr<const FieldFile> step = m_series.step(time_step);
        const auto n_points = static_cast<Eigen::Index>(xi.size() / 3);
        const auto n_fields = static_cast<Eigen::Index>(m_series.fields().size());
        Eigen::Map<ModeMatrix> result(values, n_points, n_fields);
        const ModeSet* modes_before = nullptr;
        std::shared_ptr<const ModeMatrix> matrix;
        for (Eigen::Index field = 0; field < n_fields; ++field) {
            const ModeSet* modes = step->modes(static_cast<std::size_t>(field), element);
            if (!modes) {
                // The file has no data for this field here.
                result.col(field).setConstant(std::numeric_limits<double>::quiet_NaN());
                continue;
            }
            if (modes != modes_before) {
                matrix = m_cache.values(*modes, xi);
                modes_before = modes;
            }
            const std::span<const double> coefficients = step->coefficients(static_cast<std::size_t>(field), element);
            result.col(field).noalias() = *matrix * Eigen::Map<const Eigen::VectorXd>(
                                                        coefficients.data(), static_cast<Eigen::Index>(coefficients.size()));
        }
    }

    double get_time(std::uint32_t time_step) { return m_series.n_steps() == 0 ? 0 : m_series.time(time_step); }

    elvis_string get_boundary_group(std::uint32_t group) { return m_mesh.groups().at(group).c_str(); }

    std::uint32_t n_parts() const { return m_mesh.n_parts() > 1 ? m_mesh.n_parts() : 0; }

    void get_parts(std::uint64_t first, std::span<std::uint32_t> parts) const {
        for (std::uint64_t index = 0; index < parts.size(); ++index) {
            parts[index] = m_mesh.elements()[first + index].part;
        }
    }

private:
    Source(const elvis::api::Host& table, Input input)
        : ConverterSource(table), m_mesh(input.geometry), m_series(host(), std::move(input.steps), m_mesh) {}

    static Input read(const std::vector<std::string>& paths, const std::string& options) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        return read_input(paths);
    }

    Mesh m_mesh;
    FieldSeries m_series;
    BasisCache m_cache;
};

} // namespace

const elvis_converter* converter_interface() { return elvis::api::converter_table<Source>(); }

const elvis_parts* parts_interface() { return elvis::api::parts_table<Source>(); }

} // namespace nektarpp
