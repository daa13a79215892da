/**
 * @file volumes.hpp
 * Volumes to hunt in, each wholly determined by a number.
 */
#pragma once

#include <core/oracle/element/volume.hpp>
#include <core/oracle/samples/random.hpp>
#include <core/plugin_host/plugin.hpp>

#include <elvis/native/volume_file.hpp>

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

/** One field, `u`, and these faces. */
void write_volume(const std::string& path, const oracle::VolumeData& data, const std::vector<native::Face>& faces);

} // namespace elvis::hunt
