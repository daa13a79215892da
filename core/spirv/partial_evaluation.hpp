#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** What runs a kernel. */
enum class SpirvTarget { graphics_card, processor };

/**
 * Of a kernel in valid SPIR-V as glslang writes it: one that computes the same, in one function without calls. What is
 * known before it runs is not computed when it runs: loops of known length are written out, conditions that are known
 * decided, arrays that they index taken apart, values that were stored not loaded again (partial evaluation, Jones,
 * Gomard and Sestoft, 1993). Floating point operations stay as they are, one by one.
 *
 * For a processor, larger loops are written out, and fetches are moved out of those that stay (hoisting.hpp).
 *
 * Drivers do the same, but look at the whole kernel again after each loop. A kernel is left as it is where a function has a
 * switch, or returns from within a loop, or from a branch within a branch behind which it goes on.
 */
std::vector<std::uint32_t> evaluate_partially(std::span<const std::uint32_t> spirv, SpirvTarget target);

} // namespace elvis
