/**
 * @file numbers.hpp
 * Numbers as Fortran programs write them: as text in columns, and as bytes in either order.
 */
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace elvis_nek5000 {

/** Columns first .. first+n-1 of a line; those beyond its end are missing. */
std::string_view columns(std::string_view line, std::size_t first, std::size_t n);

/** Words between blanks. */
std::vector<std::string_view> words(std::string_view line);

/** The number that fills the text but for blanks around it. */
std::optional<std::int64_t> parse_integer(std::string_view text);
/** Also without a digit before the point (.31E+01), with D for E, and without a letter (1.0-100). */
std::optional<double> parse_real(std::string_view text);

/** How numbers are stored. */
struct ByteFormat {
    /** 4 or 8. */
    std::size_t real_size = 4;
    /** The file has the other byte order than this machine. */
    bool is_swapped = false;
};

/** From the four bytes that mark the byte order: the number 6.54321. */
std::optional<bool> is_swapped(const char* mark);

/** values.size() reals from bytes. */
void decode(const ByteFormat& format, const char* bytes, std::span<double> values);
std::uint32_t decode_integer(const ByteFormat& format, const char* bytes);

} // namespace elvis_nek5000
