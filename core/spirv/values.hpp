#pragma once

#include <core/spirv/module.hpp>

#include <optional>
#include <utility>

namespace elvis {

/** What is known of a module's values: their types, numbers of constants, and what composites consist of. */
class SpirvValues {
public:
    /** The module gets the constants that are made. */
    explicit SpirvValues(SpirvModule& module);

    SpirvId make_id() { return m_module.bound()++; }
    void note_type(SpirvId value, SpirvId type);
    SpirvId type_of(SpirvId value) const { return m_types.at(value); }

    /** Of a constant that is a bool (0 or 1), or an integer of 32 bits. */
    std::optional<std::uint32_t> number(SpirvId value) const;
    /** The constant of such a type. */
    SpirvId constant(SpirvId type, std::uint32_t number);
    bool is_bool(SpirvId type) const { return definition(type).op == spv::OpTypeBool; }
    bool is_int(SpirvId type) const { return definition(type).op == spv::OpTypeInt && definition(type).words[2] == 32; }

    /** That a value is the result of this OpCompositeConstruct. */
    void note_composite(SpirvId value, const SpirvInstruction& construct);
    /** Of a composite. 0 where it is not known. */
    SpirvId component(SpirvId value, std::uint32_t k);
    /** Of a type; 0 of one that isn't composite, or whose length is not known. */
    std::uint32_t component_count(SpirvId type) const;
    SpirvId component_type(SpirvId type, std::uint32_t k) const;

private:
    void note(const SpirvInstruction& global);
    SpirvId add(const SpirvInstruction& constant);
    SpirvId null_constant(SpirvId type);
    const SpirvInstruction& definition(SpirvId id) const { return m_definitions.at(id); }

    SpirvModule& m_module;
    /** Of types and constants. */
    std::map<SpirvId, SpirvInstruction> m_definitions;
    /** By value. */
    std::vector<SpirvId> m_types;
    std::map<SpirvId, std::uint32_t> m_numbers;
    std::map<std::pair<SpirvId, std::uint32_t>, SpirvId> m_constants;
    /** By type. */
    std::map<SpirvId, SpirvId> m_nulls;
    std::map<SpirvId, std::vector<SpirvId>> m_composites;
};

} // namespace elvis
