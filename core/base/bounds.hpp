/**
 * @file bounds.hpp
 * Boxes along the axes: x, y, z of the least corner, then of the largest.
 */
#pragma once

#include <array>
#include <cmath>

namespace elvis {

/** From corner to corner. */
inline double diagonal_of(const std::array<double, 6>& bounds) {
    return std::hypot(bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]);
}

} // namespace elvis
