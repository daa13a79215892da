/**
 * @file channels.hpp
 * What pixels of a picture hold, written into the caller's arrays.
 */
#pragma once

#include "handles.hpp"

#include <cstddef>

namespace elvis::library {

/** Where the caller's pixels begin, and how far they are apart in bytes; 0: without gaps. */
struct PixelArray {
    void* destination = nullptr;
    std::ptrdiff_t row_stride = 0, pixel_stride = 0;
};

/** Throws InvalidArgument where the picture lacks the channel, or it is not written in such numbers. */
void copy_channel(const Picture& picture, const PixelArray& array, elvis_channel channel, elvis_number number);

} // namespace elvis::library
