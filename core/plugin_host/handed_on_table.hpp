/**
 * @file handed_on_table.hpp
 * A volume, seen as a plugin's, that hands each question on to another one, in which its elements have other places.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>

#include <elvis/plugin.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace elvis {

/**
 * Classes, fields, snippets and all that is no element's own are those of the other volume. A class to be served has besides
 * what api::runtime_table asks for: probe(), and a constructor for files, which is never called.
 */
class HandedOnTable : public api::RuntimeVolume {
public:
    /** `n_elements`: by class. The volume that is asked must outlive it. */
    HandedOnTable(const api::Host& host, const elvis::RuntimeVolume& asked, const std::vector<std::uint64_t>& n_elements);

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

protected:
    using Read = std::function<void(std::uint64_t element, std::uint64_t n, std::uint64_t at)>;

    /**
     * Calls read(first element of the volume that is asked, count, first of what is asked for) for elements that follow each
     * other there, too.
     */
    virtual void for_each_run(std::uint64_t first, std::uint64_t count, const Read& read) const = 0;
    /** Whether the volume that is asked knows values of the element. Else they are NaN. */
    virtual bool is_known(std::uint64_t) const { return true; }

    const elvis::RuntimeVolume& asked() const { return m_asked; }
    /** Of each class, and behind the last. */
    const std::vector<std::uint64_t>& first_of_class() const { return m_first_of_class; }
    /** As elements are counted here. */
    void set_faces(std::vector<elvis_face> faces) { m_faces = std::move(faces); }
    /** All faces of the volume that is asked, some at once. */
    void read_faces(const std::function<void(elvis_face)>& take) const;

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
    /** What a call of `get_buffer` of the other volume says; the own texts stay. */
    const BufferInfo& buffer_info(std::uint32_t buffer, std::uint32_t field);
    /** for_each_run, with what the volume that is asked throws as plugins throw it. */
    void read_runs(std::uint64_t first, std::uint64_t count, const Read& read) const;
    /** Of one element. */
    std::uint64_t place_there(std::uint64_t element) const;

    const elvis::RuntimeVolume& m_asked;
    std::vector<std::uint64_t> m_first_of_class;
    std::vector<elvis_face> m_faces;
    std::map<std::pair<std::uint32_t, std::uint32_t>, ClassField> m_class_fields;
    std::map<std::pair<std::uint32_t, std::uint32_t>, BufferInfo> m_buffers;
    std::map<std::uint32_t, ClassSnippet> m_snippets;
};

/** What the volume that is asked lacks, a table lacks, too: the host then finds the same other ways. */
template <class Table> elvis_runtime table_like(const RuntimeVolume& asked) {
    elvis_runtime table = *api::runtime_table<Table>();
    if (!asked.has_field_ranges()) {
        table.get_field_ranges = nullptr;
    }
    if (!asked.has_derivative_bounds()) {
        table.get_field_derivative_bounds = nullptr;
    }
    if (!asked.has_jacobian_checks()) {
        table.check_jacobians = nullptr;
    }
    if (!asked.has_evaluation()) {
        table.evaluate_mapping = nullptr;
        table.evaluate_field = nullptr;
    }
    return table;
}

} // namespace elvis
