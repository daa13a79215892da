/**
 * @file reference_corners.hpp
 * Corners of the reference shapes and of their faces (elvis/element.h).
 */
#pragma once

#include <elvis/element.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace elvis {

/** Reference coordinates of corner `corner`. */
std::array<double, 3> reference_corner(elvis_shape shape, std::uint32_t corner);

/** Corners of a local face as digits, around it; of two-dimensional shapes face 0 is the element. */
std::string_view face_corners(elvis_shape shape, std::uint32_t local_face);

} // namespace elvis
