#pragma once

#include <core/spirv/values.hpp>

namespace elvis {

/**
 * The value of an expression of integers of 32 bits and bools, where what is known of its operands tells it; 0 where it
 * does not. Floating point is left to the device, which rounds as it rounds.
 */
SpirvId fold(const SpirvInstruction& expression, SpirvValues& values);

} // namespace elvis
