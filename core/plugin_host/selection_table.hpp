/**
 * @file selection_table.hpp
 * A selection of elements, seen as a plugin's volume: each question is handed on to the whole.
 */
#pragma once

#include <core/plugin_host/selected_volume.hpp>

#include <elvis/plugin.hpp>

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

class SelectionTable : public api::RuntimeVolume {
public:
    /** Not asked: volumes are made by selected_volume(). */
    static std::uint32_t probe(const char*) { return 0; }
    SelectionTable(const api::Host& host, const std::string& path, const std::string& options);
    SelectionTable(const api::Host& host, const elvis::RuntimeVolume& whole, std::vector<std::uint64_t> elements,
                   SelectedFaces faces);

    void get_info(elvis_volume_info& info) override;
    void get_class(std::uint32_t element_class, elvis_element_class& out) override;
    void get_field(std::uint32_t field, elvis_field& out) override;
    void get_class_field(std::uint32_t element_class, std::uint32_t field, elvis_class_field& out) override;
    double get_time(std::uint32_t time_step) override;
    void get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) override;
    void get_snippet(std::uint32_t element_class, elvis_snippet& out) override;
    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) override;
    void fill_buffer(const elvis_fill_request& request, void* destination) override;

    void get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers);
    void get_faces(std::uint64_t first, api::StructArray<elvis_face> faces);
    elvis_string get_boundary_group(std::uint32_t group);
    elvis_certainty get_field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
                                     std::span<double> ranges);
    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians);
    void evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element, std::span<const double> xi,
                        double* values, double* gradients);
    elvis_certainty get_field_derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                std::uint64_t count, std::span<double> bounds);
    elvis_certainty get_field_apex_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                          std::uint64_t count, std::span<double> bounds);
    elvis_certainty check_jacobians(std::uint64_t first, double tolerance, api::StructArray<elvis_jacobian_check> checks);

private:
    struct ClassField {
        ClassFieldInfo info;
        std::vector<elvis_constant> constants;
    };
    struct ClassSnippet {
        Snippet snippet;
        std::vector<elvis_text> sources;
    };

    using DerivativeBounder = elvis_certainty (elvis::RuntimeVolume::*)(std::uint32_t, std::uint32_t, std::uint64_t,
                                                                        std::uint64_t, std::span<DerivativeBounds>) const;

    elvis_certainty bound_derivatives(DerivativeBounder bounder, std::uint32_t field, std::uint32_t time_step,
                                      std::uint64_t first, std::uint64_t count, std::span<double> bounds) const;
    void read_faces();
    std::int64_t position(std::int64_t element) const;
    /** What a call of `get_buffer` of the whole says; the selection's own texts stay. */
    const BufferInfo& buffer_info(std::uint32_t buffer, std::uint32_t field);
    template <class Read> void for_each_run(std::uint64_t first, std::uint64_t count, Read read) const;

    const elvis::RuntimeVolume& m_whole;
    std::vector<std::uint64_t> m_elements;
    /** Of each class, in m_elements, and behind the last. */
    std::vector<std::uint64_t> m_first_of_class;
    std::vector<elvis_face> m_faces;
    std::map<std::pair<std::uint32_t, std::uint32_t>, ClassField> m_class_fields;
    std::map<std::pair<std::uint32_t, std::uint32_t>, BufferInfo> m_buffers;
    std::map<std::uint32_t, ClassSnippet> m_snippets;
};

} // namespace elvis
