/**
 * @file spirv.hpp
 * What tests ask of SPIR-V.
 */
#pragma once

#include <glslang/SPIRV/spirv.hpp>
#include <spirv-tools/libspirv.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::test {

/** How many instructions of this kind a kernel has. */
inline std::size_t count_of(const std::vector<std::uint32_t>& spirv, spv::Op op) {
    std::size_t count = 0;
    for (std::size_t at = 5; at < spirv.size(); at += spirv[at] >> spv::WordCountShift) {
        count += (spirv[at] & spv::OpCodeMask) == op ? 1 : 0;
    }
    return count;
}

inline bool is_valid(const std::vector<std::uint32_t>& spirv) {
    return spvtools::SpirvTools(SPV_ENV_VULKAN_1_3).Validate(spirv);
}

} // namespace elvis::test
