#pragma once

#include <core/spirv/values.hpp>

namespace elvis {

/** Drops what nothing depends on from the body of a function that calls no other: also stores that nothing loads. */
void drop_dead_code(std::vector<SpirvInstruction>& body, const SpirvValues& values);

} // namespace elvis
