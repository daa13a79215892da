/**
 * @file application.hpp
 * `elvis view`: the window with its panels.
 */
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

struct Options {
    /** A scene, or the files of a volume; may be empty. */
    std::vector<std::string> files;
    std::string device;
    std::optional<std::array<int, 2>> size;
    /** Times what the screen asks for; 0: as last time. */
    double text_scale = 0;
    bool validation = false;
    /** If not empty: a file that tells, as JSON, what is on the screen and where; rewritten with every change. For tests. */
    std::string description;
};

/** Returns when the window is closed. Throws Error if there is no display, or no device. */
void run(const Options& options);

} // namespace elvis::view
