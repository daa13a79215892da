/**
 * @file description.hpp
 * Everything a plugin says about a volume, as numbers that can be compared, and questions about parts of it.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/plugin_host/source_volume.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace elvis::conformance {

/** Name of a part of the description, and a hash of what the plugin says about it. */
using Description = std::vector<std::pair<std::string, std::uint64_t>>;

/** Of the first elements and records, so that large volumes take no longer than small ones. */
Description describe(const RuntimeVolume& volume);
Description describe(const SourceVolume& source);

/** Names of the parts that differ, separated by commas; empty if none does. */
std::string difference(const Description& a, const Description& b);

/** Something that a plugin is asked for items first .. first+count-1 of; calls may run at the same time. */
struct Query {
    std::string name;
    std::uint64_t n_items = 0;
    std::function<std::vector<double>(std::uint64_t first, std::uint64_t count)> ask;
};

/** `max_items` limits n_items. */
std::vector<Query> queries(const RuntimeVolume& volume, std::uint64_t max_items);
std::vector<Query> queries(const SourceVolume& source, std::uint64_t max_items);

/** Records of a buffer without offset and with origins 0, uint converted to double. An Error if more than that is written. */
std::vector<double> read_buffer(const RuntimeVolume& volume, std::uint32_t buffer, std::uint32_t field, std::uint32_t time_step,
                                std::uint64_t first, std::uint64_t count);

} // namespace elvis::conformance
