#include <core/render/field/field_range.hpp>
#include <core/render/field/sampled_range.hpp>
#include <core/render/field/shown_field.hpp>
#include <core/volume/field/field_extrema.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Rounding of a float32 field value, relative to the largest: what evaluations of orders up to 10 show (5e-7), doubled. */
constexpr double float32_value_error = 1e-6;

/** Offsets to choose from, over the range: each is a copy of the field. */
constexpr double n_offsets = 16;

FieldRange magnitude_range(const std::vector<FieldRange>& components) {
    double lower = 0, upper = 0;
    for (const FieldRange& range : components) {
        const double near = range.lower > 0 ? range.lower : range.upper < 0 ? -range.upper : 0;
        const double far = std::max(std::abs(range.lower), std::abs(range.upper));
        lower += near * near;
        upper += far * far;
    }
    return {std::sqrt(lower), std::sqrt(upper)};
}

/** Whether neighbours may have different values on a face that they share. */
bool jumps(const Expression& expression, const RuntimeVolume& volume) {
    const std::vector<NodeId> needed = expression.graph().needed({expression.value()});
    return std::any_of(needed.begin(), needed.end(), [&](NodeId id) {
        const Node& node = expression.graph().node(id);
        if (node.operation == Operation::field) {
            return volume.fields()[node.field].continuity != ELVIS_CONTINUITY_CONTINUOUS;
        }
        // Gradients of continuous fields jump, and so does all that tells elements apart.
        return n_operands(node.operation) == 0 && node.operation != Operation::constant &&
               node.operation != Operation::position;
    });
}

} // namespace

bool FieldChoice::operator==(const FieldChoice& other) const {
    if (is_own_boundary || other.is_own_boundary) {
        return is_own_boundary == other.is_own_boundary;
    }
    if (expression && other.expression) {
        return expression == other.expression || expression->text() == other.expression->text();
    }
    return !expression && !other.expression && field == other.field && component == other.component;
}

std::string ShownFields::key(const FieldChoice& field) {
    if (field.is_own_boundary) {
        return "own boundary";
    }
    if (field.expression) {
        return "= " + field.expression->text();
    }
    // A component is a matter of constants, but a magnitude takes the field without offset.
    std::string key = (field.component < 0 ? "magnitude " : "component ") + std::to_string(field.field);
    return field.offset ? key.append(" about ").append(std::to_string(*field.offset)) : key;
}

FieldSelection ShownFields::selection(const FieldChoice& field, std::uint32_t time_step) {
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

std::vector<double> ShownFields::middles(std::uint32_t field, std::uint32_t time_step) {
    std::vector<double> result;
    for (const FieldRange& range : of_components(field, time_step).first) {
        const double middle = 0.5 * (range.lower + range.upper);
        result.push_back(std::isfinite(middle) ? middle : 0.0);
    }
    return result;
}

double ShownFields::offset(const FieldChoice& field) const {
    return field.is_own_boundary || field.expression || field.component < 0
               ? 0.0
               : m_data.field_offset(static_cast<std::uint32_t>(field.component));
}

FieldChoice ShownFields::about(const FieldChoice& field, double value, std::uint32_t time_step) {
    FieldChoice result = field;
    if (field.is_own_boundary) {
        return result;
    }
    const FieldRange whole = range(field, time_step);
    const double step = (whole.upper - whole.lower) / n_offsets;
    if (!field.expression && field.component >= 0 && step > 0 && std::isfinite(step)) {
        const double wanted = std::clamp(value, whole.lower, whole.upper);
        result.offset = whole.lower + std::round((wanted - whole.lower) / step) * step;
    }
    return result;
}

ShownComponent ShownFields::component(const FieldChoice& field) const {
    if (field.is_own_boundary) {
        return {0, 1, true};
    }
    if (field.expression) {
        return {0, 1, jumps(*field.expression, m_volume)};
    }
    const FieldInfo& info = m_volume.fields()[field.field];
    return {field.component, info.n_components, info.continuity != ELVIS_CONTINUITY_CONTINUOUS};
}

const ShownFields::Ranges& ShownFields::of_components(std::uint32_t field, std::uint32_t time_step) {
    // Kept once it is known: finding it may be cancelled.
    auto found = m_of_components.find({field, time_step});
    if (found == m_of_components.end()) {
        elvis_certainty certainty = ELVIS_ESTIMATED;
        std::vector<FieldRange> all;
        if (m_volume.has_field_ranges()) {
            all = ranges_from_plugin(m_volume, field, time_step, certainty);
        } else {
            all = sampled(field, time_step);
        }
        found = m_of_components.try_emplace({field, time_step}, std::move(all), certainty).first;
    }
    return found->second;
}

std::vector<FieldRange> ShownFields::sampled(std::uint32_t field, std::uint32_t time_step) {
    const std::uint32_t n_components = m_volume.fields()[field].n_components;
    m_data.select({{{field, std::vector<double>(n_components, 0.0)}}, time_step, nullptr});
    return ranges_from_samples(m_device, m_volume, m_data, n_components);
}

const FieldExtrema& ShownFields::extrema(const FieldChoice& field, std::uint32_t time_step) {
    const std::string name = field.expression ? key(field) : key(field) + "." + std::to_string(field.component);
    auto known = m_extrema.find({name, time_step});
    if (known == m_extrema.end()) {
        known = m_extrema.try_emplace({name, time_step}, found_extrema(field, time_step)).first;
    }
    return known->second;
}

FieldExtrema ShownFields::found_extrema(const FieldChoice& field, std::uint32_t time_step) {
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

FieldRange ShownFields::range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
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

double ShownFields::float32_error(const FieldChoice& field, std::uint32_t time_step, double offset) {
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

} // namespace elvis
