#include <core/base/infinity.hpp>
#include <core/surface/ribbon_set.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace elvis {

void RibbonSet::add(std::span<const Vector3> points, std::span<const Vector3> sides) {
    assert(points.size() == sides.size());
    const auto across = [&](std::size_t i) { return scaled(sides[i], 0.5 * width); };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Piece piece{minus(points[i], across(i)), plus(points[i], across(i)), minus(points[i + 1], across(i + 1)),
                          plus(points[i + 1], across(i + 1))};
        if (points[i] != points[i + 1] &&
            std::ranges::all_of(piece, [](const Vector3& corner) { return std::isfinite(length(corner)); })) {
            pieces.push_back(piece);
        }
    }
}

std::array<double, 6> RibbonSet::bounds() const {
    if (pieces.empty()) {
        return {-width, -width, -width, width, width, width};
    }
    std::array<double, 6> box{infinity, infinity, infinity, -infinity, -infinity, -infinity};
    for (const Piece& piece : pieces) {
        for (const Vector3& corner : piece) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                box[axis] = std::min(box[axis], corner[axis]);
                box[3 + axis] = std::max(box[3 + axis], corner[axis]);
            }
        }
    }
    return box;
}

} // namespace elvis
