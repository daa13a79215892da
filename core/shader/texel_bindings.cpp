#include <core/shader/texel_bindings.hpp>

#include <map>

namespace elvis {

// Of the SPIR-V specification (Khronos Group): instructions and their operands.
std::set<std::uint32_t> texel_bindings(std::span<const std::uint32_t> spirv) {
    constexpr std::size_t header_words = 5;
    constexpr std::uint32_t op_variable = 59, op_decorate = 71, decoration_binding = 33, uniform_constant = 0;
    std::map<std::uint32_t, std::uint32_t> bindings;
    std::set<std::uint32_t> found;
    for (std::size_t at = header_words; at < spirv.size();) {
        const std::uint32_t op = spirv[at] & 0xffffu, n_words = spirv[at] >> 16u;
        if (op == op_decorate && spirv[at + 2] == decoration_binding) {
            bindings[spirv[at + 1]] = spirv[at + 3];
        }
        // Decorations stand before variables. Nothing else that kernels have is of this storage class.
        if (op == op_variable && spirv[at + 3] == uniform_constant) {
            found.insert(bindings.at(spirv[at + 2]));
        }
        at += n_words;
    }
    return found;
}

} // namespace elvis
