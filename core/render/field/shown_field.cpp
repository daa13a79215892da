#include <core/render/field/shown_field.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Offsets to choose from, over the range: each is a copy of the field. */
constexpr double n_offsets = 16;

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

double ShownFields::upload(const FieldChoice& field, std::uint32_t time_step) {
    m_data.select(m_ranges.selection(field, time_step));
    return field.is_own_boundary || field.expression || field.component < 0
               ? 0.0
               : m_data.field_offset(static_cast<std::uint32_t>(field.component));
}

FieldChoice ShownFields::about(const FieldChoice& field, double value, std::uint32_t time_step) {
    FieldChoice result = field;
    if (field.is_own_boundary) {
        return result;
    }
    const FieldRange whole = m_ranges.range(field, time_step);
    const double step = (whole.upper - whole.lower) / n_offsets;
    if (!field.expression && field.component >= 0 && step > 0 && std::isfinite(step)) {
        const double wanted = std::clamp(value, whole.lower, whole.upper);
        result.offset = whole.lower + std::round((wanted - whole.lower) / step) * step;
    }
    return result;
}

bool may_jump(const FieldChoice& field, const RuntimeVolume& volume) {
    return field.is_own_boundary || (field.expression ? jumps(*field.expression, volume)
                                                      : volume.fields()[field.field].continuity != ELVIS_CONTINUITY_CONTINUOUS);
}

ShownComponent ShownFields::component(const FieldChoice& field) const {
    const bool is_scalar = field.is_own_boundary || field.expression;
    return {is_scalar ? 0 : field.component, is_scalar ? 1 : m_volume.fields()[field.field].n_components,
            may_jump(field, m_volume)};
}

} // namespace elvis
