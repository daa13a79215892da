/**
 * @file input.hpp
 * Which of the user's files is the mesh, and which are states.
 */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace elvis_hopr {

/** 100 for meshes and states, 0 for other files. */
std::uint32_t probe(const std::string& path);

struct Input {
    std::string mesh;
    /** Time steps; may be none. */
    std::vector<std::string> states;
};

/** Where the user names no mesh, it is the file beside the first state that this names. */
Input find_input(const std::vector<std::string>& paths);

} // namespace elvis_hopr
