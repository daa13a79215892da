/**
 * @file texel_bindings.hpp
 * What compiled code says of its buffers.
 */
#pragma once

#include <cstdint>
#include <set>
#include <span>

namespace elvis {

/** Bindings that SPIR-V declares as texel buffers (shaders/arithmetic/read_only.glsl). The code is what a compiler made. */
std::set<std::uint32_t> texel_bindings(std::span<const std::uint32_t> spirv);

} // namespace elvis
