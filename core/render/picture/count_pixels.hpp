/**
 * @file count_pixels.hpp
 * Counts of a picture that has been put together from others.
 */
#pragma once

#include <core/render/frame.hpp>

#include <cstddef>
#include <cstdint>

namespace elvis {

/** Adds flags to those of a pixel, and counts it by such as it did not have. */
void add_flags(Frame& frame, std::size_t pixel, std::uint32_t flags);

/** Sets what is counted of pixels, from the frame's flags, elements and depths; what is counted of work stays. */
void count_pixels(Frame& frame);

} // namespace elvis
