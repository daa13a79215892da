/**
 * @file hunt.hpp
 * Draws scenes, judges them, and adds up what is found.
 */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace elvis::hunt {

struct Options {
    std::vector<std::string> scene_files;
    std::uint64_t first = 0, n_scenes = 30;
    double seconds = 1e18;
    /** All if empty. */
    std::vector<std::string> kinds;
    std::vector<std::string> precisions{"float32", "float64"};
    std::string size, folder, json, device;
    /** What surfaces take from each other: none, rows, depths or all; in turn if empty. */
    std::string sharing;
    std::vector<std::string> files;
    /** All volumes also with each class in two; only some if false. */
    bool splits = false;
    bool is_quiet = false;
};

/** The exit status: 1 if there are silent errors. */
int hunt(const Options& options);

/** Of files that --json wrote. */
int print_sum(const std::vector<std::string>& files, const std::string& json);

} // namespace elvis::hunt
