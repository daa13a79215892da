/**
 * @file bounds.hpp
 * Boxes along the axes: x, y, z of the least corner, then of the largest.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cmath>

namespace elvis {

/** From corner to corner. */
inline double diagonal_of(const std::array<double, 6>& bounds) {
    return std::hypot(bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]);
}

inline Vector3 middle_of(const std::array<double, 6>& bounds) {
    return {0.5 * (bounds[0] + bounds[3]), 0.5 * (bounds[1] + bounds[4]), 0.5 * (bounds[2] + bounds[5])};
}

} // namespace elvis
