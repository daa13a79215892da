/**
 * @file pdf_picture.hpp
 * A still picture as PDF: its pixels as they are, and what is written on it as text and shapes around them.
 */
#pragma once

#include <core/session/still_picture.hpp>

#include <string>

namespace elvis {

/**
 * One page, on which 96 pixels are an inch, as in SVG. The pixels are those of the PNG without annotation, `bits` (8 or 16) a
 * channel.
 */
std::string pdf_picture(const StillPicture& still, int bits);

/** Writes it; appears whole or not at all. Throws Error naming the file. */
void write_pdf_picture(const StillPicture& still, const std::string& path, int bits);

} // namespace elvis
