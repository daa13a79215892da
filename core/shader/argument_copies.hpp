/**
 * @file argument_copies.hpp
 * Takes copies of arguments out of compiled code.
 */
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/**
 * GLSL copies arguments: the compiler copies each variable that is an argument into a new one, calls with that, and copies an
 * inout one back. Drivers compile member by member what is copied: that of a large structure costs them as much as the
 * functions do. Here the variable itself becomes the argument wherever that makes no difference:
 *
 *   - the function does not write to the parameter, or the copy is copied back at once;
 *   - the variable is a whole one of the caller, and no other argument of the call;
 *   - nothing writes to it between the copy and the call.
 *
 * Names of things, which are for people, are left out. `spirv` is what glslang made, without optimization.
 */
std::vector<std::uint32_t> drop_argument_copies(std::span<const std::uint32_t> spirv);

} // namespace elvis
