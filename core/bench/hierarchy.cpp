#include <core/base/milliseconds.hpp>
#include <core/base/vector3.hpp>
#include <core/bench/bench.hpp>

#include <core/hierarchy/hierarchy.hpp>

#include <chrono>
#include <cmath>
#include <random>

namespace elvis {

HierarchyResult bench_hierarchy(std::uint64_t n_items) {
    // A bent grid, whose boxes overlap as those of curved elements do.
    const auto n = static_cast<std::uint64_t>(std::ceil(std::cbrt(static_cast<double>(n_items))));
    const double h = 2.0 / static_cast<double>(n);
    std::vector<double> boxes;
    boxes.reserve(6 * n_items);
    for (std::uint64_t item = 0; item < n_items; ++item) {
        Vector3 q{};
        for (std::uint64_t axis = 0, rest = item; axis < 3; ++axis, rest /= n) {
            q[axis] = -1 + h * static_cast<double>(rest % n);
        }
        Vector3 lower{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis] = q[axis] + 0.06 * std::sin(M_PI * q[(axis + 1) % 3]) * std::cos(M_PI * q[(axis + 2) % 3]);
        }
        boxes.insert(boxes.end(), {lower[0], lower[1], lower[2], lower[0] + 1.2 * h, lower[1] + 1.2 * h, lower[2] + 1.2 * h});
    }
    const auto start = std::chrono::steady_clock::now();
    const Hierarchy hierarchy(boxes, {0, 0, 0});
    HierarchyResult result;
    result.n_items = n_items;
    result.wall_milliseconds = milliseconds_since(start);
    result.depth = hierarchy.depth();

    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(-0.9, 0.9);
    constexpr int n_queries = 10000;
    std::vector<std::uint32_t> found;
    for (int query = 0; query < n_queries; ++query) {
        hierarchy.find({coordinate(random), coordinate(random), coordinate(random)}, 0, found);
    }
    result.boxes_a_query = static_cast<double>(found.size()) / n_queries;
    return result;
}

} // namespace elvis
