/**
 * @file plugin.cpp
 * Conversion plugin for meshes and grid functions of MFEM.
 */
#include "boundary_groups.hpp"
#include "field.hpp"
#include "nurbs/nurbs_function.hpp"
#include "saved_cycle.hpp"

#include <elvis/native/space.hpp>
#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace {

using namespace elvis_mfem;

/** Meshes without nodes are linear: a grid function of the vertices. */
GridFunction linear_nodes(std::vector<double> coordinates) {
    GridFunction nodes;
    nodes.n_components = 3;
    nodes.is_interleaved = true;
    nodes.values = std::move(coordinates);
    return nodes;
}

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return is_mesh(path) || is_root(path) ? 100 : 0; }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(host), m_cycles(find_cycles(paths)), m_mesh(read_mesh(m_cycles.front().mesh)), m_groups(m_mesh) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        GridFunction nodes = m_mesh.nodes ? std::move(*m_mesh.nodes) : linear_nodes(std::move(m_mesh.coordinates));
        // Discontinuous nodes: vertices are topology only, as in periodic meshes.
        m_has_corner_ids = nodes.collection.family == Family::h1;
        m_mapping = make_function("nodes", m_cycles.front().mesh, std::move(nodes));
        int digits = m_cycles.front().fields.empty() ? m_mesh.digits : 0;
        for (const SavedCycle& cycle : m_cycles) {
            digits = std::max(digits, read_step(cycle));
        }
        // 8 digits are 26.6 bits. Files of small integers say nothing about the precision of what wrote them.
        constexpr int least_digits = 6;
        m_mantissa_bits =
            std::min(53u, static_cast<std::uint32_t>(std::ceil(std::max(digits, least_digits) * std::log2(10.0))));
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = static_cast<std::uint32_t>(m_mesh.dimension);
        info.n_elements = m_mesh.elements.size();
        info.n_corner_ids = m_has_corner_ids ? m_mesh.n_vertices : 0;
        info.n_fields = static_cast<std::uint32_t>(fields().size());
        info.n_time_steps = static_cast<std::uint32_t>(m_cycles.size());
        info.n_boundary_groups = static_cast<std::uint32_t>(m_groups.names().size());
        info.mantissa_bits = m_mantissa_bits;
    }

    void get_field(std::uint32_t field, elvis_source_field& out) override {
        const ElementFunction& source = *fields()[field];
        out.name = source.name().c_str();
        out.n_components = static_cast<std::uint32_t>(source.n_components());
        out.continuity = source.continuity();
        out.transform = source.transform();
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            const MeshElement& source = m_mesh.elements[first + index];
            elvis_source_element element{};
            element.shape = shape(source.geometry);
            std::fill_n(element.geometry_order, m_mesh.dimension,
                        static_cast<std::uint32_t>(std::max(1, m_mapping->native_space(first + index).order)));
            const auto corners = corner_vertices(source.geometry);
            for (std::size_t corner = 0; corner < corners.size(); ++corner) {
                element.corners[corner] = source.vertices[static_cast<std::size_t>(corners[corner])];
            }
            const int n_faces = elvis::native::n_faces(static_cast<elvis::native::Shape>(element.shape));
            for (int face = 0; face < 6; ++face) {
                element.face_groups[face] = face < n_faces ? m_groups.of_face(source, face) : ELVIS_GROUP_NONE;
            }
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            const auto [order, is_contained] = fields()[field]->native_space(first + index);
            elvis_source_space space{};
            std::fill_n(space.order, m_mesh.dimension, static_cast<std::uint32_t>(order));
            space.is_contained = is_contained ? 1 : 0;
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        // In the plane the nodes have two components.
        std::ranges::fill(positions, 0.0);
        m_mapping->evaluate(element, xi, positions.data(), 3);
    }

    void sample(std::uint32_t step, std::uint64_t element, std::span<const double> xi, double* values) override {
        std::size_t stride = 0;
        for (const auto& field : m_steps[step]) {
            stride += field->n_components();
        }
        for (const auto& field : m_steps[step]) {
            field->evaluate(element, xi, values, stride);
            values += field->n_components();
        }
    }

    double get_time(std::uint32_t step) { return m_cycles[step].time; }

    elvis_string get_boundary_group(std::uint32_t group) { return m_groups.names()[group].c_str(); }

private:
    using Functions = std::vector<std::unique_ptr<const ElementFunction>>;

    /** Of the first step: names and spaces of all. */
    const Functions& fields() const { return m_steps.front(); }

    /** Most decimal digits of the values. */
    int read_step(const SavedCycle& cycle) {
        Functions functions;
        int digits = 0;
        if (m_mesh.solution) {
            functions.push_back(make_function("solution", cycle.mesh, std::move(*m_mesh.solution)));
            digits = m_mesh.digits;
        }
        for (std::size_t index = 0; index < cycle.fields.size(); ++index) {
            host().check_cancelled();
            const SavedField& field = cycle.fields[index];
            int own_digits = 0;
            GridFunction function = read_solution(field.path, &own_digits);
            digits = std::max(digits, own_digits);
            check_space(index, function, field.path);
            functions.push_back(make_function(field.name, field.path, std::move(function)));
        }
        if (functions.empty()) {
            functions.push_back(std::make_unique<AttributeFunction>(m_mesh));
        }
        m_steps.push_back(std::move(functions));
        return digits;
    }

    /** Fields keep their space over time. */
    void check_space(std::size_t field, const GridFunction& function, const std::string& path) {
        GridFunction space{.collection = function.collection,
                           .nurbs_order = function.nurbs_order,
                           .n_components = function.n_components,
                           .is_interleaved = false,
                           .values = {}};
        if (m_steps.empty()) {
            m_spaces.push_back(std::move(space));
        } else if (const GridFunction& first = m_spaces[field]; first.collection != space.collection ||
                                                                first.nurbs_order != space.nurbs_order ||
                                                                first.n_components != space.n_components) {
            throw elvis::api::Error(
                ELVIS_ERROR_UNSUPPORTED, path,
                "the space of the field is another one than at the first time step, which is not supported");
        }
    }

    void check_dimension(const Collection& collection, const std::string& path) const {
        if (collection.dimension != 0 && collection.dimension != m_mesh.dimension) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                    "the finite element collection is of dimension " + std::to_string(collection.dimension) +
                                        ", but the mesh of dimension " + std::to_string(m_mesh.dimension));
        }
        if (collection.is_vector() && m_mesh.dimension < m_mesh.space_dimension) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                    "Nedelec and Raviart-Thomas fields on surfaces in space are not supported");
        }
    }

    std::unique_ptr<const ElementFunction> make_function(std::string name, const std::string& path, GridFunction function) {
        if (function.nurbs_order > 0) {
            return std::make_unique<NurbsFunction>(std::move(name), path, std::move(function), m_mesh);
        }
        check_dimension(function.collection, path);
        try {
            if (!m_topology && Space::needs_topology(function.collection)) {
                m_topology.emplace(m_mesh);
            }
        } catch (const std::invalid_argument& error) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, error.what());
        }
        return std::make_unique<Field>(std::move(name), path, std::move(function), m_mesh, m_topology ? &*m_topology : nullptr);
    }

    std::vector<SavedCycle> m_cycles;
    Mesh m_mesh;
    BoundaryGroups m_groups;
    std::optional<Topology> m_topology;
    bool m_has_corner_ids = true;
    std::uint32_t m_mantissa_bits = 53;
    std::unique_ptr<const ElementFunction> m_mapping;
    std::vector<Functions> m_steps;
    /** Of the fields, without values. */
    std::vector<GridFunction> m_spaces;
};

} // namespace

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("MFEM mesh", ".mesh"),
                                         elvis::api::file_format("MFEM grid function, after its mesh", ".gf"),
                                         elvis::api::file_format("MFEM VisIt collection", ".mfem_root")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.mfem", .name = "MFEM reader", .version = "1.0.0", .vendor = "ElVis",
             .description = "Converts meshes and grid functions of MFEM: H1, L2, Nedelec, Raviart-Thomas and NURBS fields.",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table);
