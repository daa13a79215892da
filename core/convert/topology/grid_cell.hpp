/**
 * @file grid_cell.hpp
 * Cells of a grid of cubes, by which positions are found again.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace elvis {

using GridCell = std::array<std::int64_t, 3>;

inline GridCell cell_of(const Vector3& x, double size) {
    const auto index = [size](double coordinate) { return static_cast<std::int64_t>(std::floor(coordinate / size)); };
    return {index(x[0]), index(x[1]), index(x[2])};
}

inline std::uint64_t hash_of(const GridCell& cell) {
    std::uint64_t value = 0;
    for (const std::int64_t index : cell) {
        value = (value ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
        value ^= value >> 29;
    }
    return value;
}

} // namespace elvis
