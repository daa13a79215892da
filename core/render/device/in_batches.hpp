/**
 * @file in_batches.hpp
 * Work of many items, in dispatches of bounded time.
 */
#pragma once

#include <algorithm>
#include <cstdint>

namespace elvis {

inline std::uint32_t divided_up(std::uint32_t number, std::uint32_t by) { return (number + by - 1) / by; }

/** Calls `dispatch(first, number)` for consecutive batches of `count` items, each of at most `most`. */
template <class Dispatch> void in_batches(std::uint32_t count, std::uint32_t most, const Dispatch& dispatch) {
    for (std::uint32_t first = 0; first < count; first += most) {
        dispatch(first, std::min(most, count - first));
    }
}

} // namespace elvis
