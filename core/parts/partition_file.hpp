/**
 * @file partition_file.hpp
 * Partitions that someone else has made: a solver, or METIS.
 */
#pragma once

#include <core/parts/partition.hpp>

#include <string>

namespace elvis {

inline constexpr std::uint32_t most_parts = 1000000;

/**
 * A text with a whole number for each element, in the order of the numbers under which people know the elements: the part to
 * which it belongs, counted from 0. What gpmetis and mpmetis write. Throws Error that names the line.
 */
Partition read_partition(const std::string& path, const RuntimeVolume& whole);

} // namespace elvis
