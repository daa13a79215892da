#include <core/parts/partition.hpp>

#include <core/hierarchy/hierarchy.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace elvis {

namespace {

using Box = std::array<double, 6>;

Box wider(std::span<const double> box, double tolerance) {
    Box result{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result[axis] = box[axis] - tolerance;
        result[axis + 3] = box[axis + 3] + tolerance;
    }
    return result;
}

bool meets(const Box& box, const HierarchyNode& node, const Vector3& centre) {
    bool is_met = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        is_met = is_met && box[axis] - centre[axis] <= double{node.upper[axis]} &&
                 box[axis + 3] - centre[axis] >= double{node.lower[axis]};
    }
    return is_met;
}

/** Whether a box meets one of those that the tree holds. */
bool meets_any(const Box& box, const Hierarchy& tree) {
    const std::span<const HierarchyNode> nodes = tree.nodes();
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
        const HierarchyNode& node = nodes[open.back()];
        open.pop_back();
        if (!meets(box, node, tree.centre())) {
            continue;
        }
        if (node.is_leaf()) {
            return true;
        }
        open.push_back(node.child);
        open.push_back(node.child + 1);
    }
    return false;
}

} // namespace

std::vector<std::uint64_t> with_surroundings(std::span<const double> boxes, const Span& part, double tolerance) {
    if (part.size() == 0) {
        return {};
    }
    const std::span<const double> own = boxes.subspan(6 * part.first, 6 * part.size());
    const Hierarchy tree(own, {own[0], own[1], own[2]});
    std::vector<std::uint64_t> elements;
    for (std::uint64_t element = 0; element < boxes.size() / 6; ++element) {
        if (part.holds(element) || meets_any(wider(boxes.subspan(6 * element, 6), tolerance), tree)) {
            elements.push_back(element);
        }
    }
    return elements;
}

std::array<double, 6> box_around(std::span<const double> boxes) {
    constexpr double infinitely_large = std::numeric_limits<double>::infinity();
    Box around{infinitely_large, infinitely_large, infinitely_large, -infinitely_large, -infinitely_large, -infinitely_large};
    for (std::size_t at = 0; at < boxes.size(); ++at) {
        double& bound = around[at % 6];
        bound = at % 6 < 3 ? std::min(bound, boxes[at]) : std::max(bound, boxes[at]);
    }
    return around;
}

std::vector<std::vector<std::uint64_t>> by_class(const RuntimeVolume& volume, std::span<const std::uint64_t> elements) {
    std::vector<std::vector<std::uint64_t>> classes;
    auto next = elements.begin();
    for (const ClassInfo& info : volume.classes()) {
        std::vector<std::uint64_t>& own = classes.emplace_back();
        for (; next != elements.end() && *next < info.first_element + info.n_elements; ++next) {
            own.push_back(*next - info.first_element);
        }
    }
    return classes;
}

} // namespace elvis
