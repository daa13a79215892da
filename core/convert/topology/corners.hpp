/**
 * @file corners.hpp
 * Numbers for corners: the source's own, or one for each distinct position.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/source_volume.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace elvis {

/** Corner numbers of an element in the order of its shape; those a shape does not have are no_corner. */
using CornerNumbers = std::array<std::uint32_t, 8>;
inline constexpr std::uint32_t no_corner = 0xffffffffu;

struct Corners {
    /** By source element. */
    std::vector<CornerNumbers> of_element;
    /** Largest extent of the box around all corners. */
    double extent = 0;
    /** Largest absolute value of a coordinate of a corner. */
    double largest_coordinate = 0;
    /** Distance below which two positions count as one. */
    double tolerance = 0;
};

/**
 * Without ids in the source, corners closer than the source's tolerance are one; where it gives none, the smaller of 1e-7 of
 * the extent and 1e-3 of the shortest distance between corners of an element: far above rounding, far below any mesh size.
 */
Corners number_corners(const SourceVolume& source, const std::vector<elvis_shape>& shapes, const TaskControl& control);

} // namespace elvis
