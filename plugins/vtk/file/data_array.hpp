/**
 * @file data_array.hpp
 * A DataArray element as numbers: ascii, inline binary or appended.
 */
#pragma once

#include "numbers.hpp"
#include "xml_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace elvis_vtk {

/** Attribute NumberOfComponents (1 if missing, 1..1024). */
std::uint32_t n_components(const XmlFile& file, pugi::xml_node array);

/** Whether the elements are numbers: Int8 .. UInt64, Float32, Float64 (not String and Bit). */
bool is_numeric(pugi::xml_node array);

/** Whether the numbers are written as text. */
bool is_text(pugi::xml_node array);

/** Significant bits of what is not text: 24 for Float32, else 53. */
std::uint32_t mantissa_bits_of_type(pugi::xml_node array);

/** The whole array; `size` numbers are expected. Errors name the line. */
Numbers read_numbers(const XmlFile& file, pugi::xml_node array, std::size_t size);

/** An array of integers, whose length is what the file holds. */
std::vector<std::int64_t> read_integers(const XmlFile& file, pugi::xml_node array);

} // namespace elvis_vtk
