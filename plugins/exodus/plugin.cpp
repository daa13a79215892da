/**
 * @file plugin.cpp
 * Conversion plugin for Exodus II files.
 */
#include "part_files.hpp"
#include "parts.hpp"

#include <plugins/cgns/element/basis.hpp>
#include <plugins/cgns/element/nodes.hpp>
#include <plugins/hdf5/file.hpp>

#include <algorithm>

namespace {

using namespace elvis_exodus;
using elvis_cgns::Matrix;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) {
        if (is_classic(path)) {
            return names_blocks(path) ? 100 : 0;
        }
        try {
            return elvis::hdf5::is_hdf5(path) && open_hdf5(path)->dimension("num_el_blk") ? 100 : 0;
        } catch (const elvis::api::Error&) {
            return 0;
        }
    }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(host), m_parts(files_of(paths, options), host) {
        for (const auto& part : m_parts.all()) {
            for (const Block& block : part->mesh.blocks()) {
                m_bases.add(block.type);
            }
        }
        for (const Field& field : fields()) {
            m_n_values += field.variables.size();
        }
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = m_parts.first().mesh.dimension();
        info.n_elements = m_parts.n_elements();
        // What several parts share, positions tell.
        info.n_corner_ids = m_parts.all().size() == 1 ? m_parts.first().mesh.n_nodes() : 0;
        info.n_fields = static_cast<std::uint32_t>(fields().size());
        info.n_time_steps = static_cast<std::uint32_t>(times().size());
        info.n_boundary_groups = static_cast<std::uint32_t>(m_parts.groups().size());
        info.mantissa_bits = m_parts.mantissa_bits();
    }

    void get_field(std::uint32_t index, elvis_source_field& out) override {
        const Field& field = fields()[index];
        out.n_components = static_cast<std::uint32_t>(field.variables.size());
        out.name = field.name.c_str();
        out.continuity = field.is_of_elements ? ELVIS_CONTINUITY_DISCONTINUOUS : ELVIS_CONTINUITY_CONTINUOUS;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            const auto [part, number, groups] = m_parts.place(first + index);
            const ElementType& type = part.mesh.block_of(number).type;
            const auto shape = elvis_cgns::shape(type.topology);
            elvis_source_element element{};
            element.shape = static_cast<elvis_shape>(shape);
            std::ranges::copy(m_bases.of(type).native_order(), element.geometry_order);
            std::size_t corner = 0;
            for (const int of_file : elvis_cgns::source_corners(type.topology)) {
                element.corners[corner++] = part.mesh.nodes(number)[static_cast<std::size_t>(of_file)];
            }
            for (int face = 0; face < static_cast<int>(std::size(element.face_groups)); ++face) {
                const std::int32_t group =
                    face < elvis::native::n_faces(shape) ? part.mesh.face_group(number, face) : ELVIS_GROUP_NONE;
                element.face_groups[face] = group == ELVIS_GROUP_NONE ? group : groups[static_cast<std::size_t>(group)];
            }
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            elvis_source_space space{};
            space.is_contained = 1;
            if (!fields()[field].is_of_elements) {
                const Parts::Place at = m_parts.place(first + index);
                std::ranges::copy(m_bases.of(at.part.mesh.block_of(at.element).type).native_order(), space.order);
            }
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const Parts::Place at = m_parts.place(element);
        const Mesh& mesh = at.part.mesh;
        const std::span<const std::uint32_t> nodes = mesh.nodes(at.element);
        Matrix at_nodes(static_cast<Eigen::Index>(nodes.size()), 3);
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            at_nodes.row(static_cast<Eigen::Index>(node)) = Eigen::Map<const Eigen::RowVector3d>(mesh.point(nodes[node]));
        }
        const auto functions = m_bases.of(mesh.block_of(at.element).type).at(xi);
        Eigen::Map<Matrix>(positions.data(), functions->rows(), 3).noalias() = *functions * at_nodes;
    }

    void sample(std::uint32_t step, std::uint64_t element, std::span<const double> xi, double* values) override {
        const Parts::Place at = m_parts.place(element);
        const std::shared_ptr<const StepValues> all = at.part.variables.values(step);
        const std::span<const std::uint32_t> nodes = at.part.mesh.nodes(at.element);
        const auto functions = m_bases.of(at.part.mesh.block_of(at.element).type).at(xi);
        Eigen::Map<Matrix> out(values, functions->rows(), static_cast<Eigen::Index>(m_n_values));
        Eigen::VectorXd at_nodes(static_cast<Eigen::Index>(nodes.size()));
        Eigen::Index component = 0;
        for (const Field& field : fields()) {
            for (std::size_t of_field = 0; of_field < field.variables.size(); ++of_field, ++component) {
                const std::vector<double>& numbers = all->components[static_cast<std::size_t>(component)];
                if (field.is_of_elements) {
                    out.col(component).setConstant(numbers[at.element]);
                    continue;
                }
                for (std::size_t node = 0; node < nodes.size(); ++node) {
                    at_nodes[static_cast<Eigen::Index>(node)] = numbers[nodes[node]];
                }
                out.col(component).noalias() = *functions * at_nodes;
            }
        }
    }

    double get_time(std::uint32_t step) { return times()[step]; }

    elvis_string get_boundary_group(std::uint32_t group) { return m_parts.groups()[group].c_str(); }

private:
    static std::vector<std::string> files_of(const std::vector<std::string>& paths, const std::string& options) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        return part_files(paths);
    }

    /** All parts have those of the first. */
    const std::vector<Field>& fields() const { return m_parts.first().variables.fields(); }
    const std::vector<double>& times() const { return m_parts.first().variables.times(); }

    Parts m_parts;
    elvis_cgns::Bases m_bases;
    std::size_t m_n_values = 0;
};

constexpr elvis_file_format formats[] = {
    elvis::api::file_format("Exodus II", ".exo"), elvis::api::file_format("Exodus II", ".e"),
    elvis::api::file_format("Exodus II", ".ex2"), elvis::api::file_format("Exodus II, a mesh", ".g")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.exodus", .name = "Exodus II reader", .version = "1.0.0", .vendor = "ElVis",
             .description = "Converts Exodus II files (.exo, .e, netCDF of every kind): elements of order 1 and 2.",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table);
