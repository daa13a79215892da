#include <core/surface/arrow_set.hpp>

#include <core/base/infinity.hpp>

#include <algorithm>

namespace elvis {

std::array<double, 6> bounds_of(const ArrowSet::Arrow& arrow) {
    const double radius = ArrowSet::head_radius * length(minus(arrow.to, arrow.from));
    std::array<double, 6> box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box[axis] = std::min(arrow.from[axis], arrow.to[axis]) - radius;
        box[3 + axis] = std::max(arrow.from[axis], arrow.to[axis]) + radius;
    }
    return box;
}

std::array<double, 6> ArrowSet::bounds() const {
    if (arrows.empty()) {
        return {-1, -1, -1, 1, 1, 1};
    }
    std::array<double, 6> all{infinity, infinity, infinity, -infinity, -infinity, -infinity};
    for (const Arrow& arrow : arrows) {
        const std::array<double, 6> box = bounds_of(arrow);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            all[axis] = std::min(all[axis], box[axis]);
            all[3 + axis] = std::max(all[3 + axis], box[3 + axis]);
        }
    }
    return all;
}

} // namespace elvis
