/**
 * @file volumes.hpp
 * Volumes to hunt in, each wholly determined by a number.
 */
#pragma once

#include <core/oracle/samples/random.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis::hunt {

/**
 * Writes the native volume of a number to a file, and returns what it is, for people. `files`: data sets that are hunted in,
 * too, one in four times; foreign ones are converted.
 */
std::string make_volume(const PluginRegistry& plugins, std::uint64_t number, const std::vector<std::string>& files,
                        const std::string& path);

} // namespace elvis::hunt
