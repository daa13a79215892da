/**
 * @file images.hpp
 * Pictures as bytes that a browser shows.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace elvis::serve {

struct Jpeg {
    std::uint32_t width = 0, height = 0;
    std::string bytes;
};

/** `shrink` pixels across and down become one, their mean. `quality` is from 1 to 100. Throws Error. */
Jpeg jpeg_of(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height, std::uint32_t shrink, int quality);

/** The bytes of `elvis render`. `folder`: where the file lies for a moment. */
std::string png_of(const picture& drawn, const std::string& folder, std::uint32_t bits = 8);

} // namespace elvis::serve
