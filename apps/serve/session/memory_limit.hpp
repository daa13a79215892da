/**
 * @file memory_limit.hpp
 * How much memory the server holds, in all sessions together, and how much it may.
 */
#pragma once

#include <apps/serve/served.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

namespace elvis::serve {

/** In main memory, and on the device if that has memory of its own. */
std::uint64_t held_bytes(const Served& served);

bool is_memory_exceeded(const Served& served);

/**
 * Throws Error if something that takes so many bytes more would go beyond what the server may hold, also without kernels that
 * are kept for later.
 */
void need_memory(const Served& served, std::uint64_t more);

/** "N MiB that it may (--memory)" */
std::string limit_text(const Served& served);

/** What a picture of so many pixels takes while it is drawn, at most: buffers of layers, and what they are merged from. */
constexpr std::uint64_t picture_bytes(std::uint64_t n_pixels) { return 128 * n_pixels; }

/** What a session, and what an item takes about, most of it kernels. */
inline constexpr std::uint64_t session_bytes = std::uint64_t{8} << 20u, item_bytes = std::uint64_t{16} << 20u;

/** Looks at the memory now and then while work goes on. For all threads that do it. */
class MemoryWatch {
public:
    explicit MemoryWatch(const Served& served) : m_served(served) {}
    /** The work has to stop. */
    bool is_exceeded();

private:
    const Served& m_served;
    std::atomic<std::chrono::steady_clock::rep> m_next = 0;
    std::atomic<bool> m_is_exceeded = false;
};

} // namespace elvis::serve
