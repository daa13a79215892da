#pragma once

#include <glslang/SPIRV/spirv.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace elvis {

// Terms are those of the SPIR-V specification (Khronos Group, unified revision 1.6).

/** Of a value, type, variable, label or function. 0 is none. */
using SpirvId = std::uint32_t;

struct SpirvInstruction {
    spv::Op op = spv::OpNop;
    /** All of its words; the first is not looked at. */
    std::vector<std::uint32_t> words;
    SpirvId type = 0, result = 0;
    /** Which words are ids: neither the type, nor the result, nor a literal. */
    std::vector<std::uint16_t> operands;
};

/** An instruction without result. */
SpirvInstruction spirv_statement(spv::Op op, const std::vector<SpirvId>& operands,
                                 const std::vector<std::uint32_t>& literals = {});
/** One with a result, which is none yet. */
SpirvInstruction spirv_expression(spv::Op op, SpirvId type, const std::vector<SpirvId>& operands,
                                  const std::vector<std::uint32_t>& literals = {});

/** Whether it ends a block. */
bool is_terminator(spv::Op op);

struct SpirvFunction {
    SpirvInstruction declaration;
    std::vector<SpirvId> parameters;
    /** From its first label to before OpFunctionEnd. */
    std::vector<SpirvInstruction> body;
    /** By label: where in the body the instruction behind it stands. */
    std::map<SpirvId, std::size_t> blocks;
};

/** A kernel, taken apart. */
struct SpirvModule {
    std::vector<std::uint32_t> header;
    /** What stands before the functions, names excepted. */
    std::vector<SpirvInstruction> globals;
    std::map<SpirvId, SpirvFunction> functions;
    SpirvId entry_point = 0;

    /** All ids are below. */
    SpirvId& bound() { return header[3]; }
};

/** Of valid SPIR-V with one entry point. Throws Error where it cannot be read. */
SpirvModule take_spirv_apart(std::span<const std::uint32_t> spirv);

/** With the entry point as the only function, whose body and decorations these are. */
std::vector<std::uint32_t> put_spirv_together(const SpirvModule& module, const std::vector<SpirvInstruction>& body,
                                              const std::vector<SpirvInstruction>& decorations);

} // namespace elvis
