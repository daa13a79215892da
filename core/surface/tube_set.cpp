#include <core/base/infinity.hpp>
#include <core/surface/tube_set.hpp>

#include <algorithm>
#include <limits>

namespace elvis {

void TubeSet::add(const std::vector<Vector3>& points) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        pieces.push_back({points[i > 0 ? i - 1 : i], points[i], points[i + 1], points[std::min(i + 2, points.size() - 1)]});
    }
}

std::array<double, 6> TubeSet::bounds() const {
    if (pieces.empty()) {
        return {-radius, -radius, -radius, radius, radius, radius};
    }
    std::array<double, 6> box{infinity, infinity, infinity, -infinity, -infinity, -infinity};
    for (const Piece& piece : pieces) {
        for (const Vector3& end : {piece[1], piece[2]}) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                box[axis] = std::min(box[axis], end[axis] - radius);
                box[3 + axis] = std::max(box[3 + axis], end[axis] + radius);
            }
        }
    }
    return box;
}

} // namespace elvis
