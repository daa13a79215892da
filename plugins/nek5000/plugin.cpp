/**
 * @file plugin.cpp
 * Conversion plugin for files of Nek5000, NekRS and Neko.
 */
#include "data_set.hpp"
#include "step_list.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace {

using elvis_nek5000::Block;
using elvis_nek5000::DataSet;
using elvis_nek5000::Quantity;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) {
        try {
            const elvis_nek5000::ByteFile file(path);
            const std::uint32_t confidence = elvis_nek5000::probe_snapshot(file);
            return confidence == 0 && elvis_nek5000::is_step_list(file) ? 100 : confidence;
        } catch (const elvis::api::Error&) {
            // What cannot be read is not ours.
            return 0;
        }
    }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : ConverterSource(host), m_data(paths, host) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        for (const Block& field : m_data.fields()) {
            m_names.push_back(name(field));
        }
        if (m_names.empty()) {
            m_names.emplace_back("number");
        }
    }

    void get_info(elvis_source_info& info) override {
        info.dimension = m_data.dimension();
        info.n_elements = m_data.n_elements();
        info.n_fields = static_cast<std::uint32_t>(m_names.size());
        info.n_time_steps = static_cast<std::uint32_t>(m_data.n_steps());
        info.n_boundary_groups = static_cast<std::uint32_t>(m_data.boundary().names().size());
        info.mantissa_bits = m_data.mantissa_bits();
        info.corner_tolerance = m_data.corner_tolerance();
    }

    void get_field(std::uint32_t index, elvis_source_field& out) override {
        out.name = m_names[index].c_str();
        out.n_components = 1;
        out.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
        if (has_fields()) {
            const Block& field = m_data.fields()[index];
            out.n_components = m_data.n_components(field);
            // Of pressure the file does not tell which of the two methods it comes from; the jumps will.
            out.continuity = field.quantity == Quantity::pressure ? ELVIS_CONTINUITY_UNKNOWN : ELVIS_CONTINUITY_CONTINUOUS;
        }
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        elvis_source_element element{};
        element.shape = m_data.dimension() == 3 ? ELVIS_SHAPE_HEXAHEDRON : ELVIS_SHAPE_QUADRILATERAL;
        std::ranges::copy(m_data.geometry_order(), element.geometry_order);
        const int n_faces = m_data.dimension() == 3 ? 6 : 4;
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            for (int face = 0; face < 6; ++face) {
                element.face_groups[face] = face < n_faces ? m_data.boundary().group(first + index, face) : ELVIS_GROUP_NONE;
            }
            out.set(index, element);
        }
    }

    void get_spaces(std::uint32_t field, std::uint64_t, elvis::api::StructArray<elvis_source_space> out) override {
        elvis_source_space space{};
        space.is_contained = 1;
        if (has_fields()) {
            std::ranges::copy(m_data.order(m_data.fields()[field]), space.order);
        }
        for (std::uint64_t index = 0; index < out.size(); ++index) {
            out.set(index, space);
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        m_data.evaluate_mapping(element, xi, positions);
    }

    void sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi, double* values) override {
        if (has_fields()) {
            m_data.sample(time_step, element, xi, values);
        } else {
            std::fill_n(values, xi.size() / 3, static_cast<double>(element + 1));
        }
    }

    double get_time(std::uint32_t time_step) { return m_data.time(time_step); }

    elvis_string get_boundary_group(std::uint32_t group) { return m_data.boundary().names()[group].c_str(); }

    std::uint32_t n_parts() const { return m_data.n_parts() > 1 ? m_data.n_parts() : 0; }

    void get_parts(std::uint64_t first, std::span<std::uint32_t> parts) const {
        for (std::uint64_t index = 0; index < parts.size(); ++index) {
            parts[index] = m_data.part(first + index);
        }
    }

private:
    /** If there are none but coordinates, the elements' numbers are the field. */
    bool has_fields() const { return !m_data.fields().empty(); }

    DataSet m_data;
    std::vector<std::string> m_names;
};

} // namespace

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Nek5000, NekRS, Neko: list of steps", ".nek5000"),
                                         elvis::api::file_format("Nek5000, NekRS, Neko: step", ".f##### .fld##")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.nek5000", .name = "Nek5000 reader", .version = "1.1.0", .vendor = "ElVis",
             .description = "Converts field files of Nek5000, NekRS and Neko (.f00001, .fld01, .nek5000).",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table,
             .parts = elvis::api::parts_table<Source>());
