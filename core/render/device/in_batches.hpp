/**
 * @file in_batches.hpp
 * Work of many items, in dispatches of bounded time.
 */
#pragma once

#include <core/vulkan/device.hpp>

#include <algorithm>
#include <cstdint>

namespace elvis {

inline std::uint32_t divided_up(std::uint32_t number, std::uint32_t by) { return (number + by - 1) / by; }

/** What all devices take in one direction. */
constexpr std::uint32_t most_groups = 1u << 15;

/**
 * Of a dispatch with so many items a work group: `most` if each is waited for. Submissions that are collected have as many as
 * fit: small dispatches would leave most of such a device idle, and large ones are parted by what their parts took
 * (core/vulkan/kernel/dispatch_pace.hpp).
 */
inline std::uint32_t items_a_dispatch(const Device& device, std::uint32_t most, std::uint32_t items_a_group = 1) {
    return device.collects_submissions() ? std::max(most, most_groups * items_a_group) : most;
}

/** Calls `dispatch(first, number)` for consecutive batches of `count` items, each of at most `most`. */
template <class Dispatch> void in_batches(std::uint32_t count, std::uint32_t most, const Dispatch& dispatch) {
    for (std::uint32_t first = 0; first < count; first += most) {
        dispatch(first, std::min(most, count - first));
    }
}

} // namespace elvis
