#pragma once

#include <core/spirv/known_values.hpp>
#include <core/spirv/writer.hpp>

namespace elvis {

/** Loads and stores of an evaluated function, of which those whose value is known are not written. */
class SpirvVariables {
public:
    SpirvVariables(const SpirvModule& module, SpirvValues& values, SpirvWriter& writer);

    // Pointers have the ids of the module that is evaluated; values and indices those of what is written.

    bool is_pointer(SpirvId id) const { return m_pointers.contains(id); }
    /** A variable of a function, as if declared here. */
    void declare(const SpirvInstruction& variable);
    /** Makes a parameter stand for what is handed over. */
    void pass(SpirvId parameter, SpirvId argument) { m_pointers[parameter] = m_pointers.at(argument); }
    /** Makes `chain` a pointer into what `base` points to. */
    void access(const SpirvInstruction& chain, SpirvId base, const std::vector<SpirvId>& indices);

    /** Whether it points into a variable of a function. */
    bool is_local(SpirvId pointer) const { return m_pointers.at(pointer).is_local; }

    SpirvId load(const SpirvInstruction& load, SpirvId pointer);
    void store(const SpirvInstruction& store, SpirvId pointer, SpirvId value);
    /** The pointer, in what is written. */
    SpirvId address(SpirvId pointer);
    /** That something else may have been stored. */
    void forget(SpirvId pointer);
    SpirvId extract(SpirvId composite, std::uint32_t component);

    KnownValues& known() { return m_known; }

private:
    struct Pointer {
        SpirvId root = 0, type = 0;
        /** Of the function, not of the module. */
        bool is_local = false;
        std::vector<SpirvId> indices;
        /** As far as the indices are known: whether they all are. */
        Place place;
        bool is_exact = true;
    };

    SpirvId address_of(const Pointer& pointer);
    void take_apart(const Place& place, SpirvId value);
    SpirvId known_value(const Place& place, SpirvId type);
    SpirvId put_together(const Place& place, SpirvId type);

    SpirvValues& m_values;
    SpirvWriter& m_writer;
    std::map<SpirvId, Pointer> m_pointers;
    KnownValues m_known;
};

} // namespace elvis
