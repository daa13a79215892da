#pragma once

#include <core/spirv/module.hpp>

#include <set>

namespace elvis {

/** Which variables code writes to, be it by functions that it calls. */
class SpirvWrites {
public:
    explicit SpirvWrites(const SpirvModule& module);

    /** Variables and parameters that instructions of this range of a function's body write to. */
    std::set<SpirvId> in(const SpirvFunction& function, std::size_t first, std::size_t end) const;

private:
    SpirvId root(SpirvId pointer) const;

    const SpirvModule& m_module;
    /** By pointer into a variable or parameter. */
    std::map<SpirvId, SpirvId> m_roots;
    /** Parameters. */
    std::set<SpirvId> m_written;
};

} // namespace elvis
