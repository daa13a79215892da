/**
 * @file plugin.cpp
 * Conversion plugin for meshes and grid functions of MFEM.
 */
#include "boundary_groups.hpp"
#include "part.hpp"
#include "saved_cycle.hpp"
#include "shared_faces.hpp"

#include <elvis/native/space.hpp>
#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace {

using namespace elvis_mfem;

/** Elements of all parts, one part after the other. */
class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return is_mesh(path) || is_root(path) ? 100 : 0; }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(host), m_cycles(find_cycles(paths)) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        int digits = 0;
        for (std::size_t part = 0; part < m_cycles.front().meshes.size(); ++part) {
            add(std::make_unique<const Part>(host, m_cycles, part), m_cycles.front().meshes[part]);
            digits = std::max(digits, m_parts.back()->digits());
        }
        add_groups();
        // 8 digits are 26.6 bits. Files of small integers say nothing about the precision of what wrote them.
        constexpr int least_digits = 6;
        m_mantissa_bits =
            std::min(53u, static_cast<std::uint32_t>(std::ceil(std::max(digits, least_digits) * std::log2(10.0))));
    }

    void get_info(elvis_source_info& info) override {
        // What several parts share, positions tell.
        const bool has_corner_ids = m_parts.size() == 1 && m_parts.front()->has_corner_ids();
        info.dimension = static_cast<std::uint32_t>(dimension());
        info.n_elements = m_first.back();
        info.n_corner_ids = has_corner_ids ? m_parts.front()->mesh().n_vertices : 0;
        info.n_fields = static_cast<std::uint32_t>(fields().size());
        info.n_time_steps = static_cast<std::uint32_t>(m_cycles.size());
        info.n_boundary_groups = static_cast<std::uint32_t>(m_groups.size());
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
            const Place at = place(first + index);
            const Part& part = *m_parts[at.part];
            const MeshElement& source = part.mesh().elements[at.element];
            elvis_source_element element{};
            element.shape = shape(source.geometry);
            std::fill_n(element.geometry_order, dimension(),
                        static_cast<std::uint32_t>(std::max(1, part.mapping().native_space(at.element).order)));
            const auto corners = corner_vertices(source.geometry);
            for (std::size_t corner = 0; corner < corners.size(); ++corner) {
                element.corners[corner] = source.vertices[static_cast<std::size_t>(corners[corner])];
            }
            const int n_faces = elvis::native::n_faces(static_cast<elvis::native::Shape>(element.shape));
            for (int face = 0; face < 6; ++face) {
                const std::int32_t own = face < n_faces ? m_part_groups[at.part].of_face(source, face) : ELVIS_GROUP_NONE;
                element.face_groups[face] = own == ELVIS_GROUP_NONE ? own : m_group_of[at.part][static_cast<std::size_t>(own)];
            }
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            const Place at = place(first + index);
            const auto [order, is_contained] = m_parts[at.part]->fields(0)[field]->native_space(at.element);
            elvis_source_space space{};
            std::fill_n(space.order, dimension(), static_cast<std::uint32_t>(order));
            space.is_contained = is_contained ? 1 : 0;
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        // In the plane the nodes have two components.
        std::ranges::fill(positions, 0.0);
        const Place at = place(element);
        m_parts[at.part]->mapping().evaluate(at.element, xi, positions.data(), 3);
    }

    void sample(std::uint32_t step, std::uint64_t element, std::span<const double> xi, double* values) override {
        const Place at = place(element);
        const auto& functions = m_parts[at.part]->fields(step);
        std::size_t stride = 0;
        for (const auto& field : functions) {
            stride += field->n_components();
        }
        for (const auto& field : functions) {
            field->evaluate(at.element, xi, values, stride);
            values += field->n_components();
        }
    }

    double get_time(std::uint32_t step) { return m_cycles[step].time; }

    elvis_string get_boundary_group(std::uint32_t group) { return m_groups[group].c_str(); }

    std::uint32_t n_parts() const { return m_parts.size() > 1 ? static_cast<std::uint32_t>(m_parts.size()) : 0; }

    void get_parts(std::uint64_t first, std::span<std::uint32_t> parts) const {
        for (std::uint64_t index = 0; index < parts.size(); ++index) {
            parts[index] = static_cast<std::uint32_t>(place(first + index).part);
        }
    }

private:
    struct Place {
        std::size_t part;
        std::size_t element;
    };

    Place place(std::uint64_t element) const {
        const auto after = std::ranges::upper_bound(m_first, element);
        const auto part = static_cast<std::size_t>(after - m_first.begin()) - 1;
        return {part, static_cast<std::size_t>(element - m_first[part])};
    }
    int dimension() const { return m_parts.front()->mesh().dimension; }
    /** Of the first part and step: names of all. */
    const std::vector<std::unique_ptr<const ElementFunction>>& fields() const { return m_parts.front()->fields(0); }

    void add(std::unique_ptr<const Part> part, const std::string& path) {
        check_like_first(*part, path);
        m_first.push_back(m_first.back() + part->mesh().elements.size());
        m_parts.push_back(std::move(part));
    }

    /** Groups of all parts, by name, their attributes ascending. */
    void add_groups() {
        const std::vector<std::vector<bool>> shared = shared_faces(m_parts);
        std::map<int, std::string> by_attribute;
        for (std::size_t part = 0; part < m_parts.size(); ++part) {
            const BoundaryGroups& groups = m_part_groups.emplace_back(m_parts[part]->mesh(), shared[part]);
            for (std::size_t group = 0; group < groups.names().size(); ++group) {
                by_attribute.try_emplace(groups.attributes()[group], groups.names()[group]);
            }
        }
        for (const auto& [attribute, name] : by_attribute) {
            if (std::ranges::find(m_groups, name) == m_groups.end()) {
                m_groups.push_back(name);
            }
        }
        for (const BoundaryGroups& groups : m_part_groups) {
            std::vector<std::int32_t>& numbers = m_group_of.emplace_back();
            for (const std::string& name : groups.names()) {
                numbers.push_back(static_cast<std::int32_t>(std::ranges::find(m_groups, name) - m_groups.begin()));
            }
        }
    }

    /** Parts have the same dimension and the same fields. */
    void check_like_first(const Part& part, const std::string& path) const {
        const auto fail = [&](const std::string& what) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, what + " is not that of the first part of the mesh");
        };
        if (m_parts.empty()) {
            return;
        }
        if (part.mesh().dimension != dimension()) {
            fail("the dimension");
        }
        for (std::size_t field = 0; field < fields().size(); ++field) {
            const ElementFunction &own = *part.fields(0)[field], &first = *fields()[field];
            if (own.n_components() != first.n_components() || own.transform() != first.transform() ||
                own.continuity() != first.continuity()) {
                fail("the space of the field '" + first.name() + "'");
            }
        }
    }

    std::vector<SavedCycle> m_cycles;
    std::vector<std::unique_ptr<const Part>> m_parts;
    /** Of each part its first element, and the number of all. */
    std::vector<std::uint64_t> m_first{0};
    std::vector<std::string> m_groups;
    std::vector<BoundaryGroups> m_part_groups;
    /** By part: which of these each of its groups is. */
    std::vector<std::vector<std::int32_t>> m_group_of;
    std::uint32_t m_mantissa_bits = 53;
};

} // namespace

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("MFEM mesh", ".mesh"),
                                         elvis::api::file_format("MFEM parallel mesh, first part", ".000000"),
                                         elvis::api::file_format("MFEM grid function, after its mesh", ".gf"),
                                         elvis::api::file_format("MFEM VisIt collection", ".mfem_root")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.mfem", .name = "MFEM reader", .version = "1.1.0", .vendor = "ElVis",
             .description = "Converts meshes and grid functions of MFEM: H1, L2, Nedelec, Raviart-Thomas and NURBS fields.",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table,
             .parts = elvis::api::parts_table<Source>());
