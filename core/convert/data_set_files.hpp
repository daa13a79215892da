/**
 * @file data_set_files.hpp
 * Which files a foreign data set may be made of, beside those that the user names.
 */
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elvis {

/**
 * A guess: plugins do not tell what they read. The files that are named; text files' own mentions of others, and what these
 * mention; and what lies beside a named file, or in a folder there, and begins as its name does (digits at the end apart):
 * `case0.f00001` has `case.re2` and `case0.f00002`. Pictures and what ElVis writes do not count unless they are named or
 * mentioned. Sorted, absolute.
 */
std::vector<std::filesystem::path> data_set_files(const std::vector<std::string>& inputs);

} // namespace elvis
