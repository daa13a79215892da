// The generator as a conversion plugin: parameters, mesh, domain, interpolation and fields put together.
#include "domain.hpp"
#include "field.hpp"
#include "interpolation.hpp"
#include "mesh.hpp"
#include "parameters.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace generator {
namespace {

// Order of the target for fields that are no polynomials.
constexpr std::uint32_t default_order = 4;

// Largest order of the native volume.
constexpr std::uint32_t max_order = 30;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return is_description(path) ? 100 : 0; }

    Source(const elvis::api::Host& table, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(table), m_parameters(read(paths, options)), m_mesh(m_parameters), m_domain(m_parameters),
          m_fields(make_fields(m_parameters.fields)) {
        for (elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON; shape <= ELVIS_SHAPE_TETRAHEDRON; ++shape)
            m_interpolations.emplace_back(shape, m_parameters.geometry_order);
        for (const Field& field : m_fields)
            check_order(field, paths.front());
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = 3;
        info.n_elements = m_mesh.n_elements();
        info.n_corner_ids = m_mesh.n_corner_ids();
        info.n_fields = static_cast<std::uint32_t>(m_fields.size());
        info.n_time_steps = m_parameters.time_steps;
        info.n_boundary_groups = static_cast<std::uint32_t>(m_mesh.groups().size());
        info.mantissa_bits = 53;
    }

    void get_field(std::uint32_t field, elvis_source_field& out) override {
        const Field& source = m_fields.at(field);
        out.n_components = source.n_components;
        out.name = source.name.c_str();
        out.continuity = source.continuity;
        out.transform = ELVIS_TRANSFORM_NONE;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> elements) override {
        for (std::uint64_t i = 0; i < elements.size(); ++i) {
            const ElementPlace place = m_mesh.place(first + i);
            elvis_source_element element{};
            element.shape = place.element->shape;
            std::ranges::fill(element.geometry_order, m_parameters.geometry_order);
            std::ranges::fill(element.face_groups, ELVIS_GROUP_NONE);
            for (std::size_t c = 0; c < place.element->corners.size(); ++c)
                element.corners[c] = m_mesh.corner_id(place, place.element->corners[c]);
            for (std::size_t face = 0; face < place.element->sides.size(); ++face)
                element.face_groups[face] = m_mesh.group(place, face);
            elements.set(i, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> spaces) override {
        const Field& source = m_fields.at(field);
        for (std::uint64_t i = 0; i < spaces.size(); ++i) {
            const auto needed = exact_order(source, m_mesh.place(first + i).element->shape);
            const std::array<std::uint32_t, 3> fallback{default_order, default_order, default_order};
            const auto order = source.order.value_or(needed.value_or(fallback));
            elvis_source_space space{};
            std::ranges::copy(order, space.order);
            space.is_contained = needed && std::ranges::equal(*needed, order, std::less_equal<>{});
            spaces.set(i, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const ElementPlace place = m_mesh.place(element);
        if (m_domain.is_affine()) {
            for (std::size_t i = 0; i < xi.size(); i += 3)
                std::ranges::copy(m_domain.position(m_mesh.lattice_point(place, &xi[i])),
                                  positions.begin() + std::ptrdiff_t(i));
            return;
        }
        const Interpolation& interpolation = m_interpolations[place.element->shape];
        const std::vector<Vec3>& nodes = interpolation.nodes();
        Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> at_nodes(nodes.size(), 3);
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            const Vec3 x = m_domain.position(m_mesh.lattice_point(place, nodes[node].data()));
            at_nodes.row(static_cast<Eigen::Index>(node)) << x[0], x[1], x[2];
        }
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> result(
            positions.data(), static_cast<Eigen::Index>(xi.size() / 3), 3);
        result.noalias() = interpolation.weights(xi) * at_nodes;
    }

    void sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi, double* values) override {
        std::vector<double> positions(xi.size());
        evaluate_mapping(element, xi, positions);
        const double time = get_time(time_step);
        for (std::size_t i = 0; i < xi.size(); i += 3)
            for (const Field& field : m_fields) {
                field.evaluate({positions[i], positions[i + 1], positions[i + 2]}, time, element, values);
                values += field.n_components;
            }
    }

    double get_time(std::uint32_t time_step) { return time_step; }

    elvis_string get_boundary_group(std::uint32_t group) { return m_mesh.groups().at(group).c_str(); }

private:
    static Parameters read(const std::vector<std::string>& paths, const std::string& options) {
        if (paths.size() != 1)
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths[1], "the generator reads one file only");
        if (!options.empty() && options != "{}")
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths[0], "the generator knows no options");
        return read_parameters(paths[0]);
    }

    // Smallest order whose native space contains the field in elements of a shape; none if there is no such order.
    std::optional<std::array<std::uint32_t, 3>> exact_order(const Field& field, elvis_shape shape) const {
        const auto degree = field.degree();
        if (!degree)
            return std::nullopt;
        if (m_domain.is_affine() && shape == ELVIS_SHAPE_HEXAHEDRON && *degree > 0) {
            // The directions of xi are those of x.
            std::array<std::uint32_t, 3> order = field.degrees();
            for (std::uint32_t& direction : order)
                direction = std::max(direction, 1u);
            return order;
        }
        // x is of order g in xi, on pyramids a function of order g in each collapsed coordinate; products add orders.
        const std::uint32_t order = m_domain.is_affine() ? *degree : *degree * m_parameters.geometry_order;
        return {{order, order, order}};
    }

    void check_order(const Field& field, const std::string& path) const {
        const auto order = exact_order(field, ELVIS_SHAPE_TETRAHEDRON);
        if (!field.order && order && (*order)[0] > max_order)
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                    "key \"fields\": \"" + field.name + "\" on this geometry is of order " +
                                        std::to_string((*order)[0]) + ", above the largest, " + std::to_string(max_order) +
                                        "; give a lower \"degree\", \"geometry_order\", or \"order\"");
    }

    Parameters m_parameters;
    Mesh m_mesh;
    Domain m_domain;
    std::vector<Field> m_fields;
    /** By shape. */
    std::vector<Interpolation> m_interpolations;
};

} // namespace
} // namespace generator

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Generator", ".json")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.generator", .name = "Generator", .version = "1.0.0", .vendor = "ElVis",
             .description = "Analytic fields on meshes of every shape and order, described by a small JSON file",
             .converter = elvis::api::converter_table<generator::Source>(), .formats = &formats_table);
