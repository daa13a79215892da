/**
 * @file pictures.hpp
 * Pictures to write on.
 */
#pragma once

#include <core/annotation/annotation.hpp>

#include <cmath>
#include <cstdint>

namespace elvis::test {

/** All pixels of one colour, and buffers that annotation must leave alone. */
inline Frame plain(std::uint32_t width, std::uint32_t height, const Color& color = {1, 1, 1, 1}) {
    Frame frame;
    frame.width = width;
    frame.height = height;
    const std::size_t n = std::size_t{width} * height;
    for (std::size_t pixel = 0; pixel < n; ++pixel) {
        frame.color.insert(frame.color.end(), color.begin(), color.end());
    }
    frame.value.assign(n, 3.5);
    frame.depth.assign(n, 2.25);
    frame.element.assign(n, 7);
    frame.normal.assign(3 * n, 0.5);
    frame.flags.assign(n, 1);
    return frame;
}

inline const double* pixel(const Frame& frame, int column, int row) {
    return &frame.color[4 * (static_cast<std::size_t>(row) * frame.width + static_cast<std::size_t>(column))];
}

inline Color color_at(const Frame& frame, int column, int row) {
    const double* p = pixel(frame, column, row);
    return {p[0], p[1], p[2], p[3]};
}

/** Piecewise linear with a step at 0.25, and colours for below, above and NaN that occur nowhere in it. */
inline ColorTable stepped_table() {
    ColorTable table;
    table.points = {{-1, {0.1, 0.2, 0.9}}, {0.25, {0.8, 0.3, 0.2}}, {0.25, {0.1, 0.7, 0.3}}, {2, {0.9, 0.9, 0.05}}};
    table.below = {0.3, 0.35, 0.4, 1};
    table.above = {0.95, 0.5, 0.0, 1};
    table.nan = {1, 0, 1, 1};
    return table;
}

} // namespace elvis::test
