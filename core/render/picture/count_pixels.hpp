/**
 * @file count_pixels.hpp
 * Counts of a picture that has been put together from others.
 */
#pragma once

#include <core/render/frame.hpp>

namespace elvis {

/** Sets what is counted of pixels, from the frame's flags and elements; what is counted of work stays. */
void count_pixels(Frame& frame);

} // namespace elvis
