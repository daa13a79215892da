/**
 * @file late_counts.hpp
 * Counts that nobody needs before the picture is there: they are read with it, and not waited for alone.
 */
#pragma once

#include <core/vulkan/buffer.hpp>
#include <core/vulkan/device.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace elvis {

/** Where commands are not collected, counts are read at once: that costs no wait. */
class LateCounts {
public:
    using Take = std::function<void(std::span<const std::uint32_t> words)>;

    explicit LateCounts(const Device& device) : m_device(device), m_kept(device, most_words * sizeof(std::uint32_t)) {}

    /** Forgets what was not taken: of a picture that was cancelled. */
    void begin();
    /** The first words of a buffer as they are now. `take` is called with them before take_all() returns. */
    void add(const Buffer& from, std::size_t n_words, Take take);
    /** Where they are to be read to; then take_all(). */
    Buffer::Read read();
    void take_all();

private:
    static constexpr std::size_t most_words = 1u << 14;
    struct Entry {
        std::size_t first, count;
        Take take;
    };

    const Device& m_device;
    Buffer m_kept;
    std::vector<Entry> m_entries;
    std::vector<std::uint32_t> m_words;
};

} // namespace elvis
