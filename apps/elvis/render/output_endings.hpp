/**
 * @file output_endings.hpp
 * Files are written in the format that their name promises, or not at all.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <cstdint>
#include <initializer_list>
#include <string>

namespace elvis::commands {

/** Throws UsageError, which names `option` and what is supported, unless the name has one of the endings, in any case. */
void need_ending(const char* option, const std::string& name, std::initializer_list<const char*> endings);

/** Of pictures that are drawn in parts: PNG. */
void need_picture_ending(const char* option, const std::string& name);
/** Of single pictures: PNG, or SVG or PDF with annotation as shapes and text. */
void need_still_ending(const char* option, const std::string& name);
/** In the format of the ending. `bits` (8 or 16) a channel. */
void write_still(const picture& drawn, const std::string& name, std::uint32_t bits);
/** Of HDF5 files. */
void need_hdf5_ending(const char* option, const std::string& name);
/** Of films, as ffmpeg knows them by their endings. */
void need_film_ending(const char* option, const std::string& name);

} // namespace elvis::commands
