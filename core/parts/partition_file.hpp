/**
 * @file partition_file.hpp
 * Partitions that someone else has made: a solver, or METIS.
 */
#pragma once

#include <core/parts/partition.hpp>

#include <elvis/native/volume_source.hpp>

#include <string>

namespace elvis {

inline constexpr std::uint32_t most_parts = 1000000;

/**
 * A text with a whole number for each element, in the order of the numbers under which people know the elements: the part to
 * which it belongs, counted from 0. What gpmetis and mpmetis write. Throws Error that names the line.
 */
Partition read_partition(const std::string& path, const RuntimeVolume& whole);

/**
 * That of the volume's own file, which has it from a solver. Throws Error if it has none. `whole` serves `source`, which is
 * null of a volume that is not native: it has none.
 */
Partition own_partition(const native::VolumeSource* source, const RuntimeVolume& whole);

} // namespace elvis
