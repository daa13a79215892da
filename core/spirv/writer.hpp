#pragma once

#include <core/spirv/values.hpp>

namespace elvis {

/** Writes the body of a function, whose variables stand at its beginning. */
class SpirvWriter {
public:
    /** Takes decorations of what is in functions out of the module: what is written gets them. */
    SpirvWriter(SpirvModule& module, SpirvValues& values);

    void write_label(SpirvId label);
    void write(SpirvInstruction statement) { m_code.push_back(std::move(statement)); }
    /** The result, which is decorated as `model` was, if there is one. */
    SpirvId write_expression(SpirvInstruction expression, SpirvId model = 0);
    /** Of a type that is a pointer. */
    SpirvId write_variable(SpirvId type);

    /** In instructions. */
    std::size_t size() const { return m_code.size(); }
    /** Of the block that is being written. */
    SpirvId label() const { return m_label; }

    /** A place to go back to. */
    struct Mark {
        std::size_t code, variables;
        SpirvId label;
    };
    Mark mark() const { return {m_code.size(), m_variables.size(), m_label}; }
    void go_back(const Mark& mark);

    /** All of it. */
    std::vector<SpirvInstruction> take();
    /** Of results in this code. */
    std::vector<SpirvInstruction> decorations(const std::vector<SpirvInstruction>& code) const;

private:
    SpirvValues& m_values;
    std::vector<SpirvInstruction> m_code, m_variables;
    SpirvId m_label = 0;
    /** By what they decorated before. */
    std::map<SpirvId, std::vector<SpirvInstruction>> m_decorations;
    /** By result. */
    std::map<SpirvId, SpirvId> m_models;
};

} // namespace elvis
