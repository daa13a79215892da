/**
 * @file rank_arrays.hpp
 * Elements of a native file as a solver has them: each rank some, in arrays.
 */
#pragma once

#include <elvis/arrays.h>
#include <elvis/native/volume_source.hpp>

#include <cstdint>
#include <vector>

namespace elvis::test {

/** Of every class the elements first .. end-1, counted in the class: one span a class. */
class RankArrays {
public:
    struct Run {
        std::uint64_t first = 0, end = 0;
    };

    RankArrays(const native::VolumeSource& source, const std::vector<Run>& of_classes) {
        const native::Description& description = source.description();
        const std::size_t n_classes = description.classes.size(), n_fields = description.fields.size();
        m_spaces.resize(n_classes * (1 + n_fields));
        m_numbers.resize(m_spaces.size());
        m_values.resize(n_fields * n_classes);
        for (std::size_t index = 0; index < n_classes; ++index) {
            const native::ElementClass& from = description.classes[index];
            const auto [first, end] = of_classes[index];
            m_numbers[index].resize((end - first) * 3 * native::n_modes(from.geometry));
            source.read_geometry(index, first, end - first, m_numbers[index]);
            m_spaces[index] = space(from.geometry);
            elvis_array_class& own = m_classes.emplace_back();
            own.struct_size = sizeof own;
            own.shape = static_cast<elvis_shape>(from.geometry.shape);
            own.n_elements = end - first;
            own.geometry_space = &m_spaces[index];
            own.geometry = m_numbers[index].data();
        }
        for (std::size_t field = 0; field < n_fields; ++field) {
            const std::size_t at = (1 + field) * n_classes;
            for (std::size_t index = 0; index < n_classes; ++index) {
                const native::Space& from = description.classes[index].fields[field];
                const auto [first, end] = of_classes[index];
                m_spaces[at + index] = space(from);
                std::vector<double>& numbers = m_numbers[at + index];
                numbers.resize((end - first) * description.fields[field].n_components * native::n_modes(from));
                source.read_field(field, 0, index, first, end - first, numbers);
                m_values[field * n_classes + index] = numbers.data();
            }
            elvis_array_field& own = m_fields.emplace_back();
            own.struct_size = sizeof own;
            own.n_components = description.fields[field].n_components;
            own.name = description.fields[field].name.c_str();
            own.unit = description.fields[field].unit.c_str();
            own.continuity = static_cast<elvis_continuity>(description.fields[field].continuity);
            own.spaces = &m_spaces[at];
            own.values = &m_values[field * n_classes];
        }
        table.struct_size = sizeof table;
        table.dimension = static_cast<std::uint32_t>(description.dimension);
        table.n_classes = static_cast<std::uint32_t>(n_classes);
        table.n_fields = static_cast<std::uint32_t>(n_fields);
        table.classes = m_classes.data();
        table.fields = m_fields.data();
    }
    RankArrays(const RankArrays&) = delete;
    RankArrays& operator=(const RankArrays&) = delete;

    /** The solver's own values of a field in a class. */
    std::vector<double>& values(std::size_t field, std::size_t element_class) {
        return m_numbers[(1 + field) * m_classes.size() + element_class];
    }

    elvis_arrays table{};

private:
    static elvis_space space(const native::Space& from) {
        elvis_space own{};
        own.struct_size = sizeof own;
        own.basis = static_cast<elvis_basis>(from.basis);
        std::copy(from.order.begin(), from.order.end(), own.order);
        return own;
    }

    /** Of geometry by class, then of fields by field and class; numbers likewise. */
    std::vector<elvis_space> m_spaces;
    std::vector<std::vector<double>> m_numbers;
    std::vector<const double*> m_values;
    std::vector<elvis_array_class> m_classes;
    std::vector<elvis_array_field> m_fields;
};

} // namespace elvis::test
