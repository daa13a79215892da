/**
 * @file file.hpp
 * The text format of the lattice plugin, described in README.md.
 */
#pragma once

#include "lattice.hpp"

#include <string>

namespace elvis::lattice {

/** Whether the file begins like one of ours; false if it cannot be read. */
bool has_our_header(const char* path);

/** Throws api::Error with file and line. */
Description read_file(const std::string& path);

} // namespace elvis::lattice
