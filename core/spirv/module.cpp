#include <core/spirv/module.hpp>

#include <core/base/error.hpp>

#include <spirv-tools/libspirv.hpp>

#include <numeric>

namespace elvis {

namespace {

constexpr std::size_t header_words = 5;

bool is_id(spv_operand_type_t type) {
    return type == SPV_OPERAND_TYPE_ID || type == SPV_OPERAND_TYPE_SCOPE_ID || type == SPV_OPERAND_TYPE_MEMORY_SEMANTICS_ID;
}

class ModuleReader {
public:
    void take(const spv_parsed_instruction_t& parsed) {
        SpirvInstruction instruction{static_cast<spv::Op>(parsed.opcode),
                                     {parsed.words, parsed.words + parsed.num_words},
                                     parsed.type_id,
                                     parsed.result_id,
                                     {}};
        for (std::uint16_t i = 0; i < parsed.num_operands; ++i) {
            if (is_id(parsed.operands[i].type)) {
                instruction.operands.push_back(parsed.operands[i].offset);
            }
        }
        put(std::move(instruction));
    }

    SpirvModule module;

private:
    void put(SpirvInstruction instruction) {
        switch (instruction.op) {
        case spv::OpName:
        case spv::OpMemberName:
            return;
        case spv::OpFunction:
            m_function = &module.functions[instruction.result];
            m_function->declaration = std::move(instruction);
            return;
        case spv::OpFunctionParameter:
            m_function->parameters.push_back(instruction.result);
            return;
        case spv::OpFunctionEnd:
            m_function = nullptr;
            return;
        case spv::OpLabel:
            m_function->blocks[instruction.result] = m_function->body.size() + 1;
            break;
        case spv::OpEntryPoint:
            module.entry_point = instruction.words[2];
            break;
        default:
            break;
        }
        (m_function ? m_function->body : module.globals).push_back(std::move(instruction));
    }

    /** The one at hand. */
    SpirvFunction* m_function = nullptr;
};

void append(std::vector<std::uint32_t>& words, const SpirvInstruction& instruction) {
    words.push_back(static_cast<std::uint32_t>(instruction.words.size() << spv::WordCountShift) | instruction.op);
    words.insert(words.end(), instruction.words.begin() + 1, instruction.words.end());
}

/** Before what stands here, all decorations must stand. */
bool comes_after_decorations(const SpirvInstruction& global) {
    return global.result != 0 && global.op >= spv::OpTypeVoid && global.op <= spv::OpTypeForwardPointer;
}

SpirvInstruction made_of(spv::Op op, std::vector<std::uint32_t> words, const std::vector<SpirvId>& operands,
                         const std::vector<std::uint32_t>& literals) {
    SpirvInstruction instruction{op, std::move(words), 0, 0, std::vector<std::uint16_t>(operands.size())};
    std::iota(instruction.operands.begin(), instruction.operands.end(), static_cast<std::uint16_t>(instruction.words.size()));
    instruction.words.insert(instruction.words.end(), operands.begin(), operands.end());
    instruction.words.insert(instruction.words.end(), literals.begin(), literals.end());
    return instruction;
}

} // namespace

SpirvInstruction spirv_statement(spv::Op op, const std::vector<SpirvId>& operands, const std::vector<std::uint32_t>& literals) {
    return made_of(op, {0}, operands, literals);
}

SpirvInstruction spirv_expression(spv::Op op, SpirvId type, const std::vector<SpirvId>& operands,
                                  const std::vector<std::uint32_t>& literals) {
    SpirvInstruction instruction = made_of(op, {0, type, 0}, operands, literals);
    instruction.type = type;
    return instruction;
}

bool is_terminator(spv::Op op) {
    switch (op) {
    case spv::OpBranch:
    case spv::OpBranchConditional:
    case spv::OpSwitch:
    case spv::OpReturn:
    case spv::OpReturnValue:
    case spv::OpUnreachable:
    case spv::OpKill:
    case spv::OpTerminateInvocation:
        return true;
    default:
        return false;
    }
}

SpirvModule take_spirv_apart(std::span<const std::uint32_t> spirv) {
    ModuleReader reader;
    reader.module.header.assign(spirv.begin(), spirv.begin() + header_words);
    const spvtools::Context context(SPV_ENV_VULKAN_1_3);
    const auto take = [](void* user, const spv_parsed_instruction_t* parsed) {
        static_cast<ModuleReader*>(user)->take(*parsed);
        return SPV_SUCCESS;
    };
    if (spvBinaryParse(context.CContext(), &reader, spirv.data(), spirv.size(), nullptr, take, nullptr) != SPV_SUCCESS) {
        throw Error("SPIR-V", "it cannot be read");
    }
    return std::move(reader.module);
}

std::vector<std::uint32_t> put_spirv_together(const SpirvModule& module, const std::vector<SpirvInstruction>& body,
                                              const std::vector<SpirvInstruction>& decorations) {
    std::vector<std::uint32_t> words = module.header;
    auto global = module.globals.begin();
    for (; global != module.globals.end() && !comes_after_decorations(*global); ++global) {
        append(words, *global);
    }
    for (const SpirvInstruction& decoration : decorations) {
        append(words, decoration);
    }
    for (; global != module.globals.end(); ++global) {
        append(words, *global);
    }
    append(words, module.functions.at(module.entry_point).declaration);
    for (const SpirvInstruction& instruction : body) {
        append(words, instruction);
    }
    append(words, spirv_statement(spv::OpFunctionEnd, {}));
    return words;
}

} // namespace elvis
