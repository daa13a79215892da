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

/** SVG and PDF have annotation as shapes and text. */
enum class PictureFormat { png, svg, pdf };
/** Of "png", "svg" or "pdf"; throws Error. */
PictureFormat picture_format(const std::string& name);
const char* mime_of(PictureFormat format);

/** The bytes of `elvis render`. `folder`: where the file lies for a moment. */
std::string file_of(const picture& drawn, const std::string& folder, PictureFormat format);

} // namespace elvis::serve
