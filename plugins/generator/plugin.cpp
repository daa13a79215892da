/**
 * @file plugin.cpp
 * Conversion plugin that makes analytic fields on named meshes.
 */
#include "description.hpp"
#include "fields.hpp"
#include "mesh.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace {

using generator::AnalyticField;
using generator::Description;
using generator::Mesh;

constexpr std::uint32_t max_order = 30;
constexpr std::uint32_t order_of_other_fields = 4;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return generator::is_description(path) ? 90 : 0; }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(host), m_path(paths.front()), m_description(generator::read_description(m_path)),
          m_mesh(m_description, m_path) {
        if (paths.size() > 1 || (!options.empty() && options != "{}")) {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, m_path,
                                    "a description stands alone: no further files, no options");
        }
        for (const std::string& name : m_description.fields) {
            m_fields.push_back(generator::make_field(name, m_description.degree));
            m_names.push_back(m_fields.back()->name());
            if (m_fields.back()->degree().value_or(0) * m_description.geometry_order > max_order) {
                throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, m_path,
                                        "degree times geometry order is above " + std::to_string(max_order));
            }
        }
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = 3;
        info.n_elements = m_mesh.n_elements();
        info.n_fields = static_cast<std::uint32_t>(m_fields.size());
        info.n_time_steps = m_description.time_steps;
        info.n_boundary_groups = static_cast<std::uint32_t>(m_mesh.groups().size());
        info.mantissa_bits = 53;
    }

    void get_field(std::uint32_t field, elvis_source_field& out) override {
        out.n_components = m_fields[field]->n_components();
        out.name = m_names[field].c_str();
        out.continuity = m_fields[field]->is_continuous() ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_DISCONTINUOUS;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            elvis_source_element element{};
            element.shape = m_mesh.shape(first + index);
            std::fill_n(element.geometry_order, 3, m_mesh.geometry_order(first + index));
            const std::array<int, 6> groups = m_mesh.face_groups(first + index);
            std::copy(groups.begin(), groups.end(), element.face_groups);
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        const std::optional<std::uint32_t> degree = m_fields[field]->degree();
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            // A polynomial of degree d in x is one of degree d g in xi.
            const std::uint32_t needed = degree.value_or(0) * m_mesh.geometry_order(first + index);
            const std::uint32_t order = m_description.order.value_or(degree ? needed : order_of_other_fields);
            elvis_source_space space{};
            std::fill_n(space.order, 3, order);
            space.is_contained = degree && order >= needed ? 1 : 0;
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        m_mesh.evaluate(element, xi, positions);
    }

    void sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi, double* values) override {
        thread_local std::vector<double> positions;
        positions.resize(xi.size());
        m_mesh.evaluate(element, xi, positions);
        const double factor = 1 + get_time(time_step);
        for (std::size_t at = 0; at < xi.size(); at += 3) {
            for (const auto& field : m_fields) {
                field->evaluate({positions[at], positions[at + 1], positions[at + 2]}, element, values);
                for (std::uint32_t component = 0; component < field->n_components(); ++component) {
                    *values++ *= factor;
                }
            }
        }
    }

    /** Fields grow by a tenth each step. */
    double get_time(std::uint32_t time_step) { return 0.1 * time_step; }

    elvis_string get_boundary_group(std::uint32_t group) { return m_mesh.groups()[group].c_str(); }

private:
    std::string m_path;
    Description m_description;
    Mesh m_mesh;
    std::vector<std::unique_ptr<const AnalyticField>> m_fields;
    std::vector<std::string> m_names;
};

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.generator", .name = "Generator", .version = "1.0.0", .vendor = "ElVis",
             .description = "Analytic fields on named meshes of any order and size, described by a small JSON file.",
             .converter = elvis::api::converter_table<Source>());
