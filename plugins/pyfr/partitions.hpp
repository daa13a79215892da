/**
 * @file partitions.hpp
 * Datasets of layout 0: one for each kind of elements and each partition.
 */
#pragma once

#include "kind.hpp"

#include <plugins/hdf5/file.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace elvis_pyfr {

struct PartSize {
    std::int64_t partition;
    std::uint64_t count;

    friend bool operator==(const PartSize&, const PartSize&) = default;
};

/** The dataset of one partition. */
struct Part {
    std::int64_t partition;
    /** Its first element in the set. */
    std::uint64_t first;
    std::uint64_t count;
    std::string name;
    elvis::hdf5::Dataset data;
};

/** A name such as `spt_hex_p12` in front of its partition, and that; -1 if it ends otherwise. */
std::pair<std::string, std::int64_t> split_partition(const std::string& name);

/**
 * All parts of a kind, by partition, whose names begin with `prefix`, such as `spt_`. They have three dimensions; elements are
 * along that of index `element_axis`, the other two agree in all parts.
 */
std::vector<Part> find_parts(const elvis::hdf5::File& file, const std::string& prefix, const Kind& kind,
                             std::size_t element_axis);

std::uint64_t n_elements(const std::vector<Part>& parts);
std::vector<PartSize> sizes(const std::vector<Part>& parts);

/** Calls read(part, first, count, offset) for what of a range of a set lies in each part; `offset` is from the range's first.
 */
template <class Read>
void for_each_part_in(const std::vector<Part>& parts, std::uint64_t first, std::uint64_t count, Read read) {
    for (const Part& part : parts) {
        const std::uint64_t from = std::max(first, part.first), to = std::min(first + count, part.first + part.count);
        if (from < to) {
            read(part, from - part.first, to - from, from - first);
        }
    }
}

} // namespace elvis_pyfr
