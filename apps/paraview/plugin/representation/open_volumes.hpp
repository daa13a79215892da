/**
 * @file open_volumes.hpp
 * The volumes that readers and representations of this process share.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <memory>
#include <string>
#include <vector>

namespace elvis_paraview {

/** A volume, and the context that it was opened with. */
struct OpenVolume {
    elvis::context context;
    elvis::data data;
};

/**
 * The volume of the files (several, of a foreign data set: geometry first), opened if it is not yet, or if the first file has
 * been written since. It is closed with its last user, and the device with the last volume. From one thread. Throws
 * elvis::error.
 */
std::shared_ptr<OpenVolume> open_volume(const std::vector<std::string>& files);

} // namespace elvis_paraview
