/**
 * @file whole_file.hpp
 * Files that are read at once.
 */
#pragma once

#include <string>

namespace elvis {

/** All of a file; throws Error if it cannot be read. */
std::string read_whole_file(const std::string& path);

} // namespace elvis
