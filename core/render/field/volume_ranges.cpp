#include <core/render/field/chosen_values.hpp>
#include <core/render/field/field_range.hpp>
#include <core/render/field/sampled_range.hpp>
#include <core/render/field/volume_ranges.hpp>
#include <core/volume/field/field_extrema.hpp>
#include <core/volume/outline.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Rounding of a float32 field value, relative to the largest: what evaluations of orders up to 10 show (5e-7), doubled. */
constexpr double float32_value_error = 1e-6;

std::string name_of(const FieldChoice& field) {
    return field.expression ? "= " + field.expression->text()
                            : std::to_string(field.field) + "." + std::to_string(field.component);
}

} // namespace

void VolumeRanges::forget_fields(std::optional<std::uint32_t> only) {
    std::erase_if(m_of_components, [&](const auto& known) { return !only || known.first.first == *only; });
    std::erase_if(m_extrema, [&](const auto& known) {
        const std::string& name = known.first.first;
        return !only || name.starts_with('=') || name.starts_with(std::to_string(*only) + ".");
    });
    m_of_expressions.clear();
    m_errors.clear();
}

const std::vector<Vector3>& VolumeRanges::outline() {
    if (m_outline.empty()) {
        m_outline =
            m_data.boxes().empty() ? outline_points(m_volume, m_device.background()) : outline_points(m_volume, m_data.boxes());
    }
    return m_outline;
}

FieldSelection VolumeRanges::selection(const FieldChoice& field, std::uint32_t time_step) {
    if (field.expression) {
        FieldSelection selection = selection_of(field.expression, m_volume, time_step);
        for (FieldSlot& slot : selection.slots) {
            slot.offset = middles(slot.field, time_step);
        }
        return selection;
    }
    // A magnitude needs the values themselves.
    const std::vector<double> whole(m_volume.fields()[field.field].n_components, 0.0);
    FieldSelection selection{{{field.field, field.component < 0 ? whole : middles(field.field, time_step)}},
                             time_step,
                             nullptr,
                             field.is_own_boundary};
    if (field.offset && field.component >= 0) {
        selection.slots[0].offset[static_cast<std::size_t>(field.component)] = *field.offset;
    }
    return selection;
}

std::vector<double> VolumeRanges::middles(std::uint32_t field, std::uint32_t time_step) {
    std::vector<double> result;
    for (const FieldRange& range : of_components(field, time_step).first) {
        const double middle = 0.5 * (range.lower + range.upper);
        result.push_back(std::isfinite(middle) ? middle : 0.0);
    }
    return result;
}

const VolumeRanges::Ranges& VolumeRanges::of_components(std::uint32_t field, std::uint32_t time_step) {
    // Kept once it is known: finding it may be cancelled.
    auto found = m_of_components.find({field, time_step});
    if (found == m_of_components.end()) {
        elvis_certainty certainty = ELVIS_ESTIMATED;
        std::vector<FieldRange> all;
        if (m_volume.has_field_ranges()) {
            all = ranges_from_plugin(m_device.background(), m_volume, field, time_step, certainty,
                                     [this] { m_device.check_task(); });
        } else {
            all = sampled(field, time_step);
        }
        found = m_of_components.try_emplace({field, time_step}, std::move(all), certainty).first;
    }
    return found->second;
}

std::vector<FieldRange> VolumeRanges::sampled(std::uint32_t field, std::uint32_t time_step) {
    const std::uint32_t n_components = m_volume.fields()[field].n_components;
    m_data.select({{{field, std::vector<double>(n_components, 0.0)}}, time_step, nullptr});
    return ranges_from_samples(m_device, m_volume, m_data, n_components);
}

const FieldExtrema& VolumeRanges::extrema(const FieldChoice& field, std::uint32_t time_step) {
    const std::string name = name_of(field);
    auto known = m_extrema.find({name, time_step});
    if (known == m_extrema.end()) {
        known = m_extrema.try_emplace({name, time_step}, found_extrema(field, time_step)).first;
    }
    return known->second;
}

FieldExtrema VolumeRanges::found_extrema(const FieldChoice& field, std::uint32_t time_step) {
    if (is_by_place(field, m_volume)) {
        return extrema_by_place(m_volume, field, time_step);
    }
    if (field.expression) {
        m_data.select(selection(field, time_step));
        return extrema_from_samples(m_device, m_volume, m_data, 0, 1);
    }
    if (const auto found = find_extrema(m_volume, field.field, field.component, time_step)) {
        return *found;
    }
    const std::uint32_t n_components = m_volume.fields()[field.field].n_components;
    m_data.select({{{field.field, std::vector<double>(n_components, 0.0)}}, time_step, nullptr});
    return extrema_from_samples(m_device, m_volume, m_data, field.component, n_components);
}

FieldRange VolumeRanges::range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
    if (!field.expression) {
        const auto& [components, how_sure] = of_components(field.field, time_step);
        if (certainty) {
            *certainty = how_sure;
        }
        return field.component < 0 ? magnitude_range(components) : components[static_cast<std::size_t>(field.component)];
    }
    const std::pair key(field.expression->text(), time_step);
    auto found = m_of_expressions.find(key);
    if (found == m_of_expressions.end()) {
        m_data.select(selection(field, time_step));
        found = m_of_expressions.try_emplace(key, ranges_from_samples(m_device, m_volume, m_data, 1)[0]).first;
    }
    if (certainty) {
        *certainty = ELVIS_ESTIMATED;
    }
    return found->second;
}

double VolumeRanges::float32_error(const FieldChoice& field, std::uint32_t time_step, double offset) {
    if (!field.expression) {
        const FieldRange of_field = range(field, time_step);
        return float32_value_error * std::max(std::abs(of_field.lower - offset), std::abs(of_field.upper - offset));
    }
    const std::pair key(field.expression->text(), time_step);
    auto found = m_errors.find(key);
    if (found == m_errors.end()) {
        m_data.select(selection(field, time_step));
        found = m_errors.try_emplace(key, rounding_of_expression(m_device, m_volume, m_data, *field.expression)).first;
    }
    return found->second;
}

void VolumeRanges::set_error(const FieldChoice& expression, std::uint32_t time_step, double error) {
    m_errors.insert_or_assign({expression.expression->text(), time_step}, error);
}

double VolumeRanges::value_rounding(const FieldChoice& field, std::uint32_t time_step) {
    if (is_by_place(field, m_volume)) {
        return rounding_by_place(m_volume, field, time_step);
    }
    if (!field.expression && (field.component >= 0 || field.is_own_boundary)) {
        return 0;
    }
    const bool is_double = m_data.precision() == Precision::float64;
    if (is_double) {
        // Rare, and not worth a kernel else.
        constexpr double narrow = 1e-6;
        const FieldRange whole = range(field, time_step);
        if (whole.upper - whole.lower > narrow * std::max({1.0, std::abs(whole.lower), std::abs(whole.upper)})) {
            return 0;
        }
    }
    return value_error(field, time_step, 0);
}

double VolumeRanges::value_error(const FieldChoice& field, std::uint32_t time_step, double offset) {
    const double error = float32_error(field, time_step, offset);
    // Expressions are sampled in the precision in use.
    return m_data.precision() == Precision::float64 && !field.expression ? 0x1p-29 * error : error;
}

} // namespace elvis
