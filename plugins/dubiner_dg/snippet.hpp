/**
 * @file snippet.hpp
 * GLSL that is written for the orders of one element class.
 */
#pragma once

#include <cstddef>
#include <string>

namespace elvis::dubiner {

/**
 * dubiner_modes.glsl, which dubiner.glsl includes: sums over all modes of the mapping and of a field, mode after mode without a
 * loop and with all numbers of the recurrences in place. Loops would be legal, but a kernel evaluates thousands of times, and
 * some drivers end all loops of an invocation after 65535 turns.
 */
std::string write_modes(std::size_t field_order, std::size_t geometry_order);

} // namespace elvis::dubiner
