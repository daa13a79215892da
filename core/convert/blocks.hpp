/**
 * @file blocks.hpp
 * Work on many elements with all processors, with results that do not depend on which one did what.
 */
#pragma once

#include <cstdint>
#include <functional>

namespace elvis {

/** Processors to use; at least 1. */
unsigned n_workers();

/**
 * Calls work(first, last) for parts of 0 .. count-1, several at a time, until all are done. The first exception thrown by a
 * part ends the others and is thrown again here.
 */
void for_each_part(std::uint64_t count, std::uint64_t part_size,
                   const std::function<void(std::uint64_t first, std::uint64_t last)>& work);

/**
 * For each block 0 .. n_blocks-1: `compute(block, worker)`, several at a time, then `commit(block, worker)`, one at a time and
 * in the order of blocks. `worker` < n_workers() tells apart what runs at the same time; a worker computes its next block after
 * it has committed its last, so that it may keep a block's results in memory of its own. Exceptions as in for_each_part.
 */
void for_each_block(std::uint64_t n_blocks, const std::function<void(std::uint64_t block, unsigned worker)>& compute,
                    const std::function<void(std::uint64_t block, unsigned worker)>& commit);

} // namespace elvis
