/**
 * @file line_width.hpp
 * How wide contours are drawn if a scene does not say.
 */
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace elvis {

/** As a width of SceneContours: by the picture's size, so that they are seen in pictures of any. */
inline constexpr double width_by_size = 0;

/** An odd number of pixels: one in small pictures, 3 from 500 rows on. */
inline double default_line_width(const std::array<std::uint32_t, 2>& size) {
    constexpr double part = 1.0 / 250;
    return 2 * std::round(0.5 * (part * std::min(size[0], size[1]) - 1)) + 1;
}

} // namespace elvis
