/**
 * @file svg_picture.hpp
 * A still picture as SVG: its pixels as they are, and what is written on it as shapes and text around them.
 */
#pragma once

#include <core/session/still_picture.hpp>

#include <string>

namespace elvis {

/** The pixels are those of the PNG without annotation, to the byte. `bits` (8 or 16) a channel. */
std::string svg_picture(const StillPicture& still, int bits);

/** Writes it; appears whole or not at all. Throws Error naming the file. */
void write_svg_picture(const StillPicture& still, const std::string& path, int bits);

} // namespace elvis
