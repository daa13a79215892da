/**
 * @file in_parts.hpp
 * Work on many items that several threads share.
 */
#pragma once

#include <core/base/background.hpp>

#include <cstdint>
#include <functional>

namespace elvis {

/**
 * Calls work(first, count) for parts of at most `part` of the items 0 .. n-1, on the background's threads and on this one, in
 * no order, and returns when all is done. Calls `check`, which may throw, on this thread between parts. What any of them throws
 * is thrown here, of several the one of the first part; parts that nobody has begun are left out then.
 */
void in_parts(Background& background, std::uint64_t n, std::uint64_t part,
              const std::function<void(std::uint64_t first, std::uint64_t count)>& work,
              const std::function<void()>& check = {});

} // namespace elvis
