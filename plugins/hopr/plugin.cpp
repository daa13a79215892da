/**
 * @file plugin.cpp
 * Conversion plugin for HOPR meshes and the states of FLEXI, GALAEXI and PICLas.
 */
#include "input.hpp"
#include "series.hpp"

#include <elvis/plugin.hpp>
#include <plugins/nodal/element_blocks.hpp>

#include <algorithm>

namespace {

using namespace elvis_hopr;
using elvis::nodal::ElementNumbers;
using elvis::nodal::ElementsKey;
using elvis::nodal::Matrix;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return elvis_hopr::probe(path); }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : Source(host, read(paths, options)) {
        if (const std::uint64_t n = m_series.n_ever_finite_volume(); n > 0) {
            host.log(ELVIS_LOG_WARNING,
                     m_series.step(0)->state.path() + ": " + std::to_string(n) +
                         " elements are finite-volume elements at some time; they are projected onto polynomials");
        }
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = 3;
        info.n_elements = m_mesh.n_elements();
        info.n_corner_ids = m_mesh.n_corner_ids();
        info.n_fields = static_cast<std::uint32_t>(m_fields.size());
        info.n_time_steps = static_cast<std::uint32_t>(std::max<std::size_t>(1, m_series.n_steps()));
        info.n_boundary_groups = static_cast<std::uint32_t>(m_mesh.groups().size());
        info.mantissa_bits = m_series.mantissa_bits();
    }

    void get_field(std::uint32_t field, elvis_source_field& out) override {
        out.name = m_fields[field].name.c_str();
        out.n_components = m_fields[field].n_components;
        out.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        const std::vector<ElementTopology> topology = m_mesh.read_topology(first, out.size());
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            elvis_source_element element{};
            element.shape = ELVIS_SHAPE_HEXAHEDRON;
            std::ranges::fill(element.geometry_order, m_mesh.is_linear(first + index) ? 1 : m_mesh.nodes().order());
            std::ranges::copy(topology[index].corners, element.corners);
            // CGNS numbers the faces of hexahedra as ElVis does.
            std::ranges::copy(topology[index].groups, element.face_groups);
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            elvis_source_space space{};
            space.is_contained = 1;
            if (!m_fields[field].is_constant) {
                std::ranges::fill(space.order, m_series.order());
                space.is_contained = m_series.is_ever_finite_volume(first + index) ? 0 : 1;
            }
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const ElementNumbers nodes =
            m_blocks.get({ElementsKey::What::geometry, 0, 0, m_mesh.n_elements(), 3 * m_mesh.nodes().size()}, element,
                         [&](std::uint64_t first, std::uint64_t count) { return m_mesh.read_nodes(first, count); });
        const auto functions = m_mesh.nodes().at(xi);
        Eigen::Map<Matrix>(positions.data(), functions->rows(), 3).noalias() =
            *functions * Eigen::Map<const Matrix>(nodes.data(), functions->cols(), 3);
    }

    void sample(std::uint32_t step, std::uint64_t element, std::span<const double> xi, double* values) override {
        const auto n_points = static_cast<Eigen::Index>(xi.size() / 3);
        if (is_bare()) {
            Eigen::Map<Eigen::VectorXd>(values, n_points).setConstant(m_mesh.is_linear(element) ? 0 : 1);
            return;
        }
        const std::shared_ptr<const Series::Step> open = m_series.step(step);
        const State& state = open->state;
        const ElementNumbers numbers =
            m_blocks.get({ElementsKey::What::values, step, 0, m_mesh.n_elements(), state.size()}, element,
                         [&](std::uint64_t first, std::uint64_t count) { return state.read(first, count); });
        const auto n_nodes = static_cast<Eigen::Index>(state.nodes().size()),
                   n_nodal = static_cast<Eigen::Index>(state.n_nodal()),
                   n_constant = static_cast<Eigen::Index>(state.n_constant());
        const Eigen::Map<const Eigen::MatrixXd> at_nodes(numbers.data(), n_nodes, n_nodal);
        const Eigen::Map<const Eigen::RowVectorXd> constants(numbers.data() + n_nodes * n_nodal, n_constant);
        Eigen::Map<Matrix> out(values, n_points, n_nodal + n_constant);
        if (open->is_finite_volume(element)) {
            out.leftCols(n_nodal).noalias() = state.cells().at(xi) * at_nodes;
        } else {
            out.leftCols(n_nodal).noalias() = *state.nodes().at(xi) * at_nodes;
        }
        out.rightCols(n_constant).rowwise() = constants;
    }

    double get_time(std::uint32_t step) { return is_bare() ? 0 : m_series.time(step); }

    elvis_string get_boundary_group(std::uint32_t group) { return m_mesh.groups()[group].c_str(); }

private:
    Source(const elvis::api::Host& host, const Input& input)
        : ConverterSource(host), m_mesh(elvis::hdf5::File(input.mesh), host), m_series(input.states, m_mesh),
          m_fields(is_bare() ? std::vector<SourceField>{{"curved", 1, true}} : m_series.fields()) {}

    static Input read(const std::vector<std::string>& paths, const std::string& options) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        return find_input(paths);
    }

    /** A mesh alone says which elements are curved. */
    bool is_bare() const { return m_series.n_steps() == 0; }

    Mesh m_mesh;
    Series m_series;
    std::vector<SourceField> m_fields;
    elvis::nodal::ElementBlocks m_blocks;
};

constexpr elvis_file_format formats[] = {elvis::api::file_format("FLEXI, GALAEXI, PICLas: state", ".h5"),
                                         elvis::api::file_format("HOPR mesh", ".h5")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.hopr", .name = "HOPR reader", .version = "1.0.0", .vendor = "ElVis",
             .description = "Converts HOPR meshes and states of FLEXI, GALAEXI and PICLas (HDF5).",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table);
