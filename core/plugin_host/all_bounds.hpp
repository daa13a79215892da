/**
 * @file all_bounds.hpp
 * Bounds of all elements of a volume, asked from several threads.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>

#include <vector>

namespace elvis {

/** min x y z, max x y z of each element. */
std::vector<double> all_bounds(const RuntimeVolume& volume);
/** The same, with how sure they are: the least that was said of any part. */
std::vector<double> all_bounds(const RuntimeVolume& volume, elvis_certainty& certainty);

} // namespace elvis
