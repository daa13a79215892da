/**
 * @file description.hpp
 * What makes a description a volume: the writer refuses what the reader would refuse.
 */
#pragma once

#include <elvis/native/volume_file.hpp>

#include <cstdint>
#include <string>

namespace elvis::native {

/** More of these than any volume has: a damaged count is found before memory is asked for. */
inline constexpr std::uint32_t most_classes = 65536;
inline constexpr std::uint32_t most_fields = 4096;
inline constexpr std::uint32_t most_components = 1024;
inline constexpr std::uint32_t most_notes = 65536;
inline constexpr std::uint32_t most_groups = 1000000;
inline constexpr std::uint32_t most_parts = 1000000;
inline constexpr std::uint64_t most_times = 10000000;
inline constexpr std::uint64_t most_elements = std::uint64_t{1} << 40;
inline constexpr std::size_t longest_text = std::size_t{1} << 20;

/** What is wrong, or an empty text. */
std::string problem_of(const Description& description);
std::string problem_of(const Face& face, std::uint64_t n_elements, std::uint64_t n_groups);

} // namespace elvis::native
