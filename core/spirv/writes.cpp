#include <core/spirv/writes.hpp>

#include <algorithm>

namespace elvis {

SpirvWrites::SpirvWrites(const SpirvModule& module) : m_module(module) {
    for (const auto& [id, function] : module.functions) {
        for (const SpirvInstruction& i : function.body) {
            if (i.op == spv::OpAccessChain || i.op == spv::OpInBoundsAccessChain) {
                m_roots[i.result] = root(i.words[3]);
            }
        }
    }
    // A function writes to what the functions that it calls write to; until there is nothing new.
    for (std::size_t count = m_written.size() + 1; count != m_written.size();) {
        count = m_written.size();
        for (const auto& [id, function] : module.functions) {
            for (const SpirvId written : in(function, 0, function.body.size())) {
                if (std::ranges::find(function.parameters, written) != function.parameters.end()) {
                    m_written.insert(written);
                }
            }
        }
    }
}

SpirvId SpirvWrites::root(SpirvId pointer) const {
    const auto found = m_roots.find(pointer);
    return found == m_roots.end() ? pointer : found->second;
}

std::set<SpirvId> SpirvWrites::in(const SpirvFunction& function, std::size_t first, std::size_t end) const {
    std::set<SpirvId> written;
    for (std::size_t at = first; at < end; ++at) {
        const SpirvInstruction& i = function.body[at];
        if (i.op == spv::OpStore) {
            written.insert(root(i.words[1]));
        } else if (i.op == spv::OpFunctionCall) {
            const std::vector<SpirvId>& parameters = m_module.functions.at(i.words[3]).parameters;
            for (std::size_t k = 0; k < parameters.size(); ++k) {
                if (m_written.contains(parameters[k])) {
                    written.insert(root(i.words[4 + k]));
                }
            }
        }
    }
    return written;
}

} // namespace elvis
