/**
 * @file picture_rows.hpp
 * Where in a picture a box can be seen.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>

#include <array>
#include <cstdint>

namespace elvis {

/**
 * The rows of a picture of this size in which rays can meet the box, `min_x, min_y, min_z, max_x, max_y, max_z`, and `margin`
 * more of them on both sides: all rows if the box reaches behind the eye, or beside it.
 */
PixelRows rows_of_box(const std::array<double, 6>& box, const Camera& camera, std::uint32_t height, double margin);

} // namespace elvis
