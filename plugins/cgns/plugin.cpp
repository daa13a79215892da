/**
 * @file plugin.cpp
 * Conversion plugin for CGNS files.
 */
#include "element/basis.hpp"
#include "mesh.hpp"
#include "solutions.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace {

using namespace elvis_cgns;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return elvis_cgns::probe(path); }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(host), m_tree(only_one(paths, options)), m_base(read_base(m_tree, host)),
          m_steps(read_time_steps(m_tree, m_base, host)), m_mesh(m_tree, m_base, m_steps.coordinates, host),
          m_solutions(m_tree, m_base, m_steps, host) {
        for (std::uint64_t element = 0; element < m_mesh.n_elements(); ++element) {
            m_bases.add(m_mesh.type(element));
        }
        for (const Field& field : m_solutions.fields()) {
            m_n_values += field.arrays.size();
        }
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = m_base.dimension;
        info.n_elements = m_mesh.n_elements();
        info.n_corner_ids = has_corner_ids() ? m_mesh.n_vertices() : 0;
        info.n_fields = is_bare() ? 1 : static_cast<std::uint32_t>(m_solutions.fields().size());
        info.n_time_steps = static_cast<std::uint32_t>(m_solutions.times().size());
        info.n_boundary_groups = static_cast<std::uint32_t>(m_mesh.groups().size());
        info.mantissa_bits = std::min(m_mesh.mantissa_bits(), m_solutions.mantissa_bits());
    }

    void get_field(std::uint32_t index, elvis_source_field& out) override {
        if (is_bare()) {
            out.name = "zone";
            out.n_components = 1;
            out.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
            return;
        }
        const Field& field = m_solutions.fields()[index];
        out.n_components = static_cast<std::uint32_t>(field.arrays.size());
        out.name = field.name.c_str();
        // Where zones meet, the file does not tell; the jumps will.
        out.continuity = field.is_of_cells  ? ELVIS_CONTINUITY_DISCONTINUOUS
                         : has_corner_ids() ? ELVIS_CONTINUITY_CONTINUOUS
                                            : ELVIS_CONTINUITY_UNKNOWN;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            const std::uint64_t number = first + index;
            const ElementType& type = m_mesh.type(number);
            elvis_source_element element{};
            element.shape = static_cast<elvis_shape>(shape(type.topology));
            std::ranges::copy(m_bases.of(type).native_order(), element.geometry_order);
            std::size_t corner = 0;
            for (const int of_file : source_corners(type.topology)) {
                element.corners[corner++] = m_mesh.nodes(number)[static_cast<std::size_t>(of_file)];
            }
            for (std::size_t face = 0; face < std::size(element.face_groups); ++face) {
                element.face_groups[face] = m_mesh.face_group(number, face);
            }
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            elvis_source_space space{};
            space.is_contained = 1;
            if (!is_bare() && !m_solutions.fields()[field].is_of_cells) {
                std::ranges::copy(m_bases.of(m_mesh.type(first + index)).native_order(), space.order);
            }
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const std::span<const std::uint32_t> nodes = m_mesh.nodes(element);
        Matrix at_nodes(static_cast<Eigen::Index>(nodes.size()), 3);
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            at_nodes.row(static_cast<Eigen::Index>(node)) = Eigen::Map<const Eigen::RowVector3d>(m_mesh.point(nodes[node]));
        }
        const auto functions = m_bases.of(m_mesh.type(element)).at(xi);
        Eigen::Map<Matrix>(positions.data(), functions->rows(), 3).noalias() = *functions * at_nodes;
    }

    void sample(std::uint32_t step, std::uint64_t element, std::span<const double> xi, double* values) override {
        if (is_bare()) {
            std::fill_n(values, xi.size() / 3, static_cast<double>(m_mesh.zone(element)));
            return;
        }
        const std::shared_ptr<const StepValues> all = m_solutions.values(step);
        const std::span<const std::uint32_t> nodes = m_mesh.nodes(element);
        const auto functions = m_bases.of(m_mesh.type(element)).at(xi);
        Eigen::Map<Matrix> out(values, functions->rows(), static_cast<Eigen::Index>(m_n_values));
        Eigen::VectorXd at_nodes(static_cast<Eigen::Index>(nodes.size()));
        std::size_t component = 0;
        for (const Field& field : m_solutions.fields()) {
            for (std::size_t of_field = 0; of_field < field.arrays.size(); ++of_field, ++component) {
                const std::vector<double>& numbers = all->components[component];
                const auto column = static_cast<Eigen::Index>(component);
                if (field.is_of_cells) {
                    out.col(column).setConstant(numbers[element]);
                    continue;
                }
                for (std::size_t node = 0; node < nodes.size(); ++node) {
                    at_nodes[static_cast<Eigen::Index>(node)] = numbers[nodes[node]];
                }
                out.col(column).noalias() = *functions * at_nodes;
            }
        }
    }

    double get_time(std::uint32_t step) { return m_solutions.times()[step]; }

    elvis_string get_boundary_group(std::uint32_t group) { return m_mesh.groups()[group].c_str(); }

private:
    static const std::string& only_one(const std::vector<std::string>& paths, const std::string& options) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        if (paths.size() > 1) {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths[1],
                                    "a CGNS file holds all of its data set, or links to it: name one file only");
        }
        return paths.front();
    }

    /** Grids without solutions have a field, too: the number of the zone. */
    bool is_bare() const { return m_solutions.fields().empty(); }

    /** Vertices are shared within unstructured zones only; elsewhere corners are matched by position. */
    bool has_corner_ids() const {
        return m_base.zones.size() == 1 && !m_base.zones.front().is_structured && m_mesh.has_shared_vertices();
    }

    Tree m_tree;
    Base m_base;
    TimeSteps m_steps;
    Mesh m_mesh;
    Solutions m_solutions;
    Bases m_bases;
    std::size_t m_n_values = 0;
};

constexpr elvis_file_format formats[] = {elvis::api::file_format("CGNS", ".cgns")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.cgns", .name = "CGNS reader", .version = "1.0.0", .vendor = "ElVis",
             .description =
                 "Converts CGNS files (.cgns, HDF5 and ADF): structured and unstructured zones, elements of order 1 to 4.",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table);
