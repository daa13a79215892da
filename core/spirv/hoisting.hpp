#pragma once

#include <core/spirv/values.hpp>

#include <vector>

namespace elvis {

/**
 * Moves fetches out of loops, of a function's body whose loops stand together as SpirvWriter writes them: those of numbers that
 * are the same in all rounds, with what tells their places (loop-invariant code motion; S. Muchnick, Advanced Compiler Design
 * and Implementation, chapter 13.2).
 *
 * A processor loads such a vector in one instruction, where a fetch takes some for each lane. On a graphics card it would cost
 * the registers that it needs for other things.
 */
void hoist_fetches(std::vector<SpirvInstruction>& body);

} // namespace elvis
