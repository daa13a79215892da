#include <core/session/volume/extrema_finder.hpp>

#include <core/render/field/chosen_values.hpp>
#include <core/volume/field/field_extrema.hpp>

namespace elvis {

FieldExtrema ExtremaFinder::of(const FieldChoice& field, std::uint32_t time_step) {
    if (!field.expression && !is_by_place(field, m_volume)) {
        if (const auto found = find_extrema(m_volume, field.field, field.component, time_step)) {
            return *found;
        }
    }
    if (!m_ranges) {
        const Device& device = m_device();
        const Precision precision = device.summary().has_float64 ? Precision::float64 : Precision::float32;
        m_data.emplace(device, m_volume, precision, nullptr);
        m_ranges.emplace(device, m_volume, *m_data);
    }
    return m_ranges->extrema(field, time_step);
}

void ExtremaFinder::forget_fields() {
    if (m_ranges) {
        m_ranges->forget_fields();
        m_data->forget_fields();
    }
}

} // namespace elvis
