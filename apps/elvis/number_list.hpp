/**
 * @file number_list.hpp
 * Lists of numbers on the command line.
 */
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace elvis::commands {

/** "1,0,0,-0.5" as `least` to `most` finite numbers; else a UsageError that names the option. */
std::vector<double> numbers(const char* option, const std::string& text, std::size_t least, std::size_t most);

/** "1,0,0" as a point. */
std::array<double, 3> point(const char* option, const std::string& text);

} // namespace elvis::commands
