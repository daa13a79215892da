#include <core/spirv/variables.hpp>

namespace elvis {

SpirvVariables::SpirvVariables(const SpirvModule& module, SpirvValues& values, SpirvWriter& writer)
    : m_values(values), m_writer(writer) {
    for (const SpirvInstruction& global : module.globals) {
        if (global.op == spv::OpVariable) {
            m_pointers[global.result] = {global.result, global.type, false, {}, {global.result}, true};
        }
    }
}

void SpirvVariables::declare(const SpirvInstruction& variable) {
    const SpirvId made = m_writer.write_variable(variable.type);
    m_pointers[variable.result] = {made, variable.type, true, {}, {made}, true};
}

void SpirvVariables::access(const SpirvInstruction& chain, SpirvId base, const std::vector<SpirvId>& indices) {
    Pointer pointer = m_pointers.at(base);
    pointer.type = chain.type;
    for (const SpirvId index : indices) {
        pointer.indices.push_back(index);
        const auto number = m_values.number(index);
        pointer.is_exact = pointer.is_exact && number;
        if (pointer.is_exact) {
            pointer.place.push_back(*number);
        }
    }
    m_pointers[chain.result] = std::move(pointer);
}

SpirvId SpirvVariables::load(const SpirvInstruction& load, SpirvId from) {
    const Pointer& pointer = m_pointers.at(from);
    const bool is_traced = pointer.is_local && pointer.is_exact;
    if (const SpirvId known = is_traced ? known_value(pointer.place, load.type) : 0) {
        return known;
    }
    SpirvInstruction made = load;
    made.words[3] = address_of(pointer);
    const SpirvId value = m_writer.write_expression(std::move(made), load.result);
    if (is_traced) {
        m_known.set(pointer.place, value);
    }
    return value;
}

void SpirvVariables::store(const SpirvInstruction& store, SpirvId to, SpirvId value) {
    const Pointer& pointer = m_pointers.at(to);
    SpirvInstruction made = store;
    made.words[1] = address_of(pointer);
    made.words[2] = value;
    m_writer.write(std::move(made));
    if (pointer.is_local) {
        forget(to);
        if (pointer.is_exact) {
            m_known.set(pointer.place, value);
        }
    }
}

SpirvId SpirvVariables::address(SpirvId pointer) { return address_of(m_pointers.at(pointer)); }

SpirvId SpirvVariables::address_of(const Pointer& pointer) {
    if (pointer.indices.empty()) {
        return pointer.root;
    }
    std::vector<SpirvId> operands{pointer.root};
    operands.insert(operands.end(), pointer.indices.begin(), pointer.indices.end());
    return m_writer.write_expression(spirv_expression(spv::OpAccessChain, pointer.type, operands));
}

void SpirvVariables::forget(SpirvId pointer) {
    const Place& place = m_pointers.at(pointer).place;
    m_known.forget_within(place);
    for (std::size_t size = 1; size < place.size(); ++size) {
        const Place outer(place.begin(), place.begin() + static_cast<std::ptrdiff_t>(size));
        if (const auto value = m_known.at(outer)) {
            take_apart(outer, *value);
            m_known.forget(place);
        }
    }
}

/** What is known of the whole place, is known of its components. */
void SpirvVariables::take_apart(const Place& place, SpirvId value) {
    m_known.forget(place);
    Place inner = place;
    inner.push_back(0);
    const std::uint32_t count = m_values.component_count(m_values.type_of(value));
    for (std::uint32_t& k = inner.back(); k < count; ++k) {
        if (!m_known.at(inner)) {
            m_known.set(inner, extract(value, k));
        }
    }
}

/** 0 where it is not known. */
SpirvId SpirvVariables::known_value(const Place& place, SpirvId type) {
    if (const auto known = m_known.at(place)) {
        return *known;
    }
    for (std::size_t size = place.size() - 1; size > 0; --size) {
        const auto outer = m_known.at({place.begin(), place.begin() + static_cast<std::ptrdiff_t>(size)});
        if (outer) {
            SpirvId value = *outer;
            for (std::size_t k = size; k < place.size(); ++k) {
                // What may never be reached may lie outside.
                if (place[k] >= m_values.component_count(m_values.type_of(value))) {
                    return 0;
                }
                value = extract(value, place[k]);
            }
            m_known.set(place, value);
            return value;
        }
    }
    return put_together(place, type);
}

/** Of its components. 0 where one of them is not known. */
SpirvId SpirvVariables::put_together(const Place& place, SpirvId type) {
    std::vector<SpirvId> components(m_known.knows_within(place) ? m_values.component_count(type) : 0);
    if (components.empty()) {
        return 0;
    }
    Place inner = place;
    inner.push_back(0);
    for (std::uint32_t& k = inner.back(); k < components.size(); ++k) {
        const auto known = m_known.at(inner);
        components[k] = known ? *known : put_together(inner, m_values.component_type(type, k));
        if (components[k] == 0) {
            return 0;
        }
    }
    const SpirvInstruction construct = spirv_expression(spv::OpCompositeConstruct, type, components);
    const SpirvId value = m_writer.write_expression(construct);
    m_values.note_composite(value, construct);
    m_known.set(place, value);
    return value;
}

SpirvId SpirvVariables::extract(SpirvId composite, std::uint32_t component) {
    if (const SpirvId known = m_values.component(composite, component)) {
        return known;
    }
    const SpirvId type = m_values.component_type(m_values.type_of(composite), component);
    return m_writer.write_expression(spirv_expression(spv::OpCompositeExtract, type, {composite}, {component}));
}

} // namespace elvis
