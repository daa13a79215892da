/**
 * @file memory_limit.hpp
 * How much memory the server holds, in all sessions together, and how much it may.
 */
#pragma once

#include <apps/serve/served.hpp>

#include <cstdint>

namespace elvis::serve {

/** In main memory, and on the device if that has memory of its own. */
std::uint64_t held_bytes(const Served& served);

bool is_memory_exceeded(const Served& served);

/** Throws Error if something that takes so many bytes more would go beyond what the server may hold. */
void need_memory(const Served& served, std::uint64_t more);

/** What a picture of so many pixels takes while it is drawn, at most: buffers of layers, and what they are merged from. */
constexpr std::uint64_t picture_bytes(std::uint64_t n_pixels) { return 128 * n_pixels; }

} // namespace elvis::serve
