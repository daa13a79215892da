/**
 * @file sparse_points.hpp
 * Points none of which is near to another.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace elvis {

class SparsePoints {
public:
    /** `distance`: the least between two of them, > 0. */
    explicit SparsePoints(double distance) : m_distance(distance) {}

    bool has_room(const Vector3& point) const {
        const Cell cell = cell_of(point);
        for (std::int64_t i = 0; i < 27; ++i) {
            const auto found = m_cells.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
            if (found == m_cells.end()) {
                continue;
            }
            for (const Vector3& other : found->second) {
                if (length(minus(other, point)) < m_distance) {
                    return false;
                }
            }
        }
        return true;
    }

    /** Whether there was room for it. */
    bool add(const Vector3& point) {
        if (!has_room(point)) {
            return false;
        }
        m_cells[cell_of(point)].push_back(point);
        return true;
    }

private:
    /** Of the length of the distance. */
    using Cell = std::array<std::int64_t, 3>;
    Cell cell_of(const Vector3& point) const {
        Cell cell{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cell[axis] = static_cast<std::int64_t>(std::floor(point[axis] / m_distance));
        }
        return cell;
    }

    double m_distance;
    std::map<Cell, std::vector<Vector3>> m_cells;
};

} // namespace elvis
