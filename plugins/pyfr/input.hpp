/**
 * @file input.hpp
 * Which of the user's files is the mesh, and which are solutions.
 */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace elvis_pyfr {

/** How sure it is that a file is PyFR's, from 0 to 100. */
std::uint32_t probe(const std::string& path);

struct Input {
    std::string mesh;
    /** Time steps; may be none. */
    std::vector<std::string> solutions;
};

/** Where the user names no mesh, it is the one beside the first solution that has its id. */
Input find_input(const std::vector<std::string>& paths);

} // namespace elvis_pyfr
