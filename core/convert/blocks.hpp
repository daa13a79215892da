/**
 * @file blocks.hpp
 * Work on many elements with all processors.
 */
#pragma once

#include <cstdint>
#include <functional>

namespace elvis {

/** Processors to use; at least 1. */
unsigned n_workers();

/**
 * Calls work(worker, first, last) for parts of 0 .. count-1 until all are done; `worker` < n_workers() tells apart what runs at
 * the same time. The first exception thrown by a part ends the others and is thrown again here. Which worker gets which part is
 * not determined: results must not depend on it.
 */
void for_each_part(std::uint64_t count, std::uint64_t part_size,
                   const std::function<void(unsigned worker, std::uint64_t first, std::uint64_t last)>& work);

} // namespace elvis
