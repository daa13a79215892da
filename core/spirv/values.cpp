#include <core/spirv/values.hpp>

namespace elvis {

namespace {

/** Of constants and OpCompositeConstruct: what stands behind the result. */
std::vector<std::uint32_t> behind_result(const SpirvInstruction& instruction) {
    return {instruction.words.begin() + 3, instruction.words.end()};
}

} // namespace

SpirvValues::SpirvValues(SpirvModule& module) : m_module(module) {
    for (const SpirvInstruction& global : module.globals) {
        note(global);
    }
}

void SpirvValues::note_type(SpirvId value, SpirvId type) {
    if (value >= m_types.size()) {
        m_types.resize(2 * value + 1);
    }
    m_types[value] = type;
}

void SpirvValues::note(const SpirvInstruction& global) {
    if (global.result == 0) {
        return;
    }
    m_definitions[global.result] = global;
    note_type(global.result, global.type);
    switch (global.op) {
    case spv::OpConstant:
        if (is_int(global.type)) {
            m_numbers[global.result] = global.words[3];
        }
        break;
    case spv::OpConstantTrue:
        m_numbers[global.result] = 1;
        break;
    case spv::OpConstantFalse:
        m_numbers[global.result] = 0;
        break;
    case spv::OpConstantComposite:
        m_composites[global.result] = behind_result(global);
        break;
    case spv::OpConstantNull:
        m_nulls[global.type] = global.result;
        if (is_int(global.type) || is_bool(global.type)) {
            m_numbers[global.result] = 0;
        }
        break;
    default:
        break;
    }
    if (const auto found = m_numbers.find(global.result); found != m_numbers.end()) {
        m_constants.emplace(std::pair(global.type, found->second), global.result);
    }
}

std::optional<std::uint32_t> SpirvValues::number(SpirvId value) const {
    const auto found = m_numbers.find(value);
    return found == m_numbers.end() ? std::nullopt : std::optional(found->second);
}

SpirvId SpirvValues::add(const SpirvInstruction& constant) {
    SpirvInstruction made = constant;
    made.result = made.words[2] = make_id();
    note(made);
    m_module.globals.push_back(std::move(made));
    return m_module.globals.back().result;
}

SpirvId SpirvValues::constant(SpirvId type, std::uint32_t number) {
    if (const auto found = m_constants.find({type, number}); found != m_constants.end()) {
        return found->second;
    }
    if (is_bool(type)) {
        return add(spirv_expression(number != 0 ? spv::OpConstantTrue : spv::OpConstantFalse, type, {}));
    }
    return add(spirv_expression(spv::OpConstant, type, {}, {number}));
}

SpirvId SpirvValues::null_constant(SpirvId type) {
    const auto found = m_nulls.find(type);
    return found != m_nulls.end() ? found->second : add(spirv_expression(spv::OpConstantNull, type, {}));
}

void SpirvValues::note_composite(SpirvId value, const SpirvInstruction& construct) {
    std::vector<SpirvId> parts = behind_result(construct);
    // A vector may consist of vectors; such are not looked into.
    if (parts.size() == component_count(construct.type)) {
        m_composites[value] = std::move(parts);
    }
}

SpirvId SpirvValues::component(SpirvId value, std::uint32_t k) {
    if (const auto found = m_composites.find(value); found != m_composites.end()) {
        return found->second.at(k);
    }
    const SpirvId type = type_of(value);
    const auto null = m_nulls.find(type);
    return null != m_nulls.end() && null->second == value ? null_constant(component_type(type, k)) : 0;
}

std::uint32_t SpirvValues::component_count(SpirvId type) const {
    const SpirvInstruction& composite = definition(type);
    switch (composite.op) {
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
        return composite.words[3];
    case spv::OpTypeArray:
        return number(composite.words[3]).value_or(0);
    case spv::OpTypeStruct:
        return static_cast<std::uint32_t>(composite.words.size() - 2);
    default:
        return 0;
    }
}

SpirvId SpirvValues::component_type(SpirvId type, std::uint32_t k) const {
    const SpirvInstruction& composite = definition(type);
    return composite.words.at(composite.op == spv::OpTypeStruct ? 2 + k : 2);
}

} // namespace elvis
