/**
 * @file png_file.hpp
 * Writes pictures as PNG.
 */
#pragma once

#include <core/render/frame.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace elvis {

/** Of a channel, with the largest level that a file's bits allow: 255, 65535. */
inline unsigned level_of(double channel, unsigned largest) {
    return static_cast<unsigned>(std::lround(largest * std::clamp(channel, 0.0, 1.0)));
}

/** The file's bytes: see write_png(). */
std::vector<unsigned char> png_bytes(const Frame& frame, int bits);

/**
 * Writes Frame::color with `bits` (8 or 16) a channel: round(c (2^bits - 1)) after clamping, no gamma; with alpha only if some
 * pixel is not opaque. Appears whole or not at all. Throws Error naming the file.
 */
void write_png(const Frame& frame, const std::string& path, int bits);

} // namespace elvis
