/**
 * @file token.hpp
 * Secrets: what nobody can guess, and comparing without telling how much was right.
 */
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace elvis::serve {

/** So many random bytes of the system, as hexadecimal digits. Throws Error. */
std::string random_digits(std::size_t n_bytes);

/** Takes as long for any two texts of these lengths. */
bool equal_in_constant_time(std::string_view a, std::string_view b);

} // namespace elvis::serve
