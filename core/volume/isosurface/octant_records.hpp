/**
 * @file octant_records.hpp
 * Octants of elements as kernels take and give them (shaders/isosurface/octant.glsl).
 */
#pragma once

#include <elvis/element.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace elvis {

/** Words of an octant on the device, and of what the kernel says of it: range and box, too. */
inline constexpr std::uint32_t octant_size = 24, octant_words = 32;
inline constexpr std::size_t octant_slope = 12, octant_error = 16, octant_scale = 17, octant_element = 18, octant_code = 19,
                             octant_curvature = 20, octant_range = 24, octant_box = 26;

/** Whether the code has room for its parts. */
bool can_divide(std::uint32_t code);
/** Appends element and code of each of the eight parts of an octant that lie in the shape; code 0 is all of the element. */
void add_octants(std::vector<std::uint32_t>& elements_and_codes, std::uint32_t element, std::uint32_t code, elvis_shape shape);

} // namespace elvis
