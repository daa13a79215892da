#include <core/spirv/writer.hpp>

#include <iterator>
#include <set>

namespace elvis {

SpirvWriter::SpirvWriter(SpirvModule& module, SpirvValues& values) : m_values(values) {
    std::set<SpirvId> kept;
    for (const SpirvInstruction& global : module.globals) {
        kept.insert(global.result);
    }
    std::erase_if(module.globals, [&](const SpirvInstruction& global) {
        const bool is_taken = global.op == spv::OpDecorate && !kept.contains(global.words[1]);
        if (is_taken) {
            m_decorations[global.words[1]].push_back(global);
        }
        return is_taken;
    });
}

void SpirvWriter::write_label(SpirvId label) {
    m_label = label;
    SpirvInstruction instruction = spirv_statement(spv::OpLabel, {label});
    instruction.operands.clear();
    instruction.result = label;
    write(std::move(instruction));
}

SpirvId SpirvWriter::write_expression(SpirvInstruction expression, SpirvId model) {
    const SpirvId result = m_values.make_id();
    expression.result = expression.words[2] = result;
    m_values.note_type(result, expression.type);
    if (m_decorations.contains(model)) {
        m_models[result] = model;
    }
    write(std::move(expression));
    return result;
}

SpirvId SpirvWriter::write_variable(SpirvId type) {
    SpirvInstruction variable = spirv_expression(spv::OpVariable, type, {}, {spv::StorageClassFunction});
    variable.result = variable.words[2] = m_values.make_id();
    m_variables.push_back(variable);
    return variable.result;
}

void SpirvWriter::go_back(const Mark& mark) {
    m_code.resize(mark.code);
    m_variables.resize(mark.variables);
    m_label = mark.label;
}

std::vector<SpirvInstruction> SpirvWriter::take() {
    m_code.insert(m_code.begin() + 1, std::move_iterator(m_variables.begin()), std::move_iterator(m_variables.end()));
    return std::move(m_code);
}

std::vector<SpirvInstruction> SpirvWriter::decorations(const std::vector<SpirvInstruction>& code) const {
    std::vector<SpirvInstruction> decorations;
    for (const SpirvInstruction& instruction : code) {
        if (const auto model = m_models.find(instruction.result); model != m_models.end()) {
            for (SpirvInstruction decoration : m_decorations.at(model->second)) {
                decoration.words[1] = instruction.result;
                decorations.push_back(std::move(decoration));
            }
        }
    }
    return decorations;
}

} // namespace elvis
