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

struct Corners {
    /** Corner numbers of each element, in the order of its shape; unused ones are -1. */
    std::vector<std::array<std::int64_t, 8>> of_element;
    /** Largest extent of the box around all corners. */
    double extent = 0;
    /** Distance below which two corners count as one. */
    double tolerance = 0;
};

/**
 * Without ids in the source, corners closer than the source's tolerance are one; where it gives none, the smaller of 1e-7 of
 * the extent and 1e-3 of the shortest distance between corners of an element: far above rounding, far below any mesh size.
 */
Corners number_corners(const SourceVolume& source, const std::vector<elvis_shape>& shapes, const TaskControl& control);

} // namespace elvis
