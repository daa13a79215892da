/**
 * @file parallel.hpp
 * Work on many pixels, by all threads.
 */
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace elvis::hunt {

/** Calls work(thread, row) for all rows. */
template <class Work> void for_rows(std::size_t n_threads, std::uint32_t n_rows, const Work& work) {
    std::atomic<std::uint32_t> next = 0;
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < n_threads; ++i)
        threads.emplace_back([&, i] {
            for (std::uint32_t row = next++; row < n_rows; row = next++)
                work(i, row);
        });
}

/** Calls work(thread, pixel, weight) for at most some of these, in even steps; the weight says for how many each stands. */
template <class Work>
void for_some(std::size_t n_threads, const std::vector<std::size_t>& pixels, std::size_t most, const Work& work) {
    const std::size_t stride = std::max<std::size_t>(1, (pixels.size() + most - 1) / most);
    const auto n = static_cast<std::uint32_t>((pixels.size() + stride - 1) / stride);
    for_rows(n_threads, n, [&](std::size_t thread, std::uint32_t i) {
        work(thread, pixels[i * stride], std::min<std::uint64_t>(stride, pixels.size() - i * stride));
    });
}

} // namespace elvis::hunt
