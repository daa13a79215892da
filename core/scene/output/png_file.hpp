/**
 * @file png_file.hpp
 * Writes pictures as PNG.
 */
#pragma once

#include <core/render/frame.hpp>

#include <string>

namespace elvis {

/**
 * Writes Frame::color with `bits` (8 or 16) a channel: round(c (2^bits - 1)) after clamping, no gamma; with alpha only if some
 * pixel is not opaque. Appears whole or not at all. Throws Error naming the file.
 */
void write_png(const Frame& frame, const std::string& path, int bits);

} // namespace elvis
