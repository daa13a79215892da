/**
 * @file elements_in_blocks.hpp
 * Elements of a large volume that are found block by block, by several threads.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/base/cancel.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace elvis {

/** Thrown where there are more elements than are wanted. */
struct TooManyElements {};

/** Calls work(block) for each block, on several threads; what it throws is thrown. */
void in_blocks(Background& background, std::uint64_t n_blocks, const TaskControl* control,
               const std::function<void(std::uint64_t block)>& work);

/**
 * What find(block, found) appends to `found`, block after block. Throws TooManyElements once there are more than `most`:
 * blocks are then left out.
 */
std::vector<std::uint64_t>
elements_in_blocks(Background& background, std::uint64_t n_blocks, std::uint64_t most, const TaskControl* control,
                   const std::function<void(std::uint64_t block, std::vector<std::uint64_t>& found)>& find);

} // namespace elvis
