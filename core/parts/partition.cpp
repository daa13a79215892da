#include <core/parts/partition.hpp>

#include <core/base/bounds.hpp>
#include <core/hierarchy/hierarchy.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace elvis {

namespace {

using Box = std::array<double, 6>;

/** Of the diagonal: boxes that are so close belong to elements that may share a point, whatever is rounded. */
constexpr double close_by = 1e-6;

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

Partition Partition::in_shares(std::uint64_t n_elements, std::uint32_t n_parts) {
    std::vector<std::vector<Span>> parts(n_parts);
    for (std::uint32_t part = 0; part < n_parts; ++part) {
        if (const Span own = share(n_elements, n_parts, part); own.size() > 0) {
            parts[part] = {own};
        }
    }
    return Partition(std::move(parts));
}

std::uint64_t Partition::n_elements(std::uint64_t part) const {
    std::uint64_t n = 0;
    for (const Span& run : m_parts[part]) {
        n += run.size();
    }
    return n;
}

std::vector<std::uint64_t> Partition::elements(std::uint64_t part) const {
    std::vector<std::uint64_t> all;
    for (const Span& run : m_parts[part]) {
        for (std::uint64_t element = run.first; element < run.end; ++element) {
            all.push_back(element);
        }
    }
    return all;
}

std::uint32_t Partition::part_of(std::uint64_t element) const {
    const auto holds = [&](const Span& run) { return run.holds(element); };
    const auto found =
        std::ranges::find_if(m_parts, [&](const std::vector<Span>& runs) { return std::ranges::any_of(runs, holds); });
    return static_cast<std::uint32_t>(found - m_parts.begin());
}

std::vector<std::uint64_t> with_surroundings(std::span<const double> boxes, std::span<const std::uint64_t> part) {
    if (part.empty()) {
        return {};
    }
    const double tolerance = close_by * diagonal_of(box_around(boxes));
    std::vector<double> own;
    for (const std::uint64_t element : part) {
        const auto box = boxes.subspan(6 * element, 6);
        own.insert(own.end(), box.begin(), box.end());
    }
    const Hierarchy tree(own, {own[0], own[1], own[2]});
    std::vector<std::uint64_t> elements;
    auto next = part.begin();
    for (std::uint64_t element = 0; element < boxes.size() / 6; ++element) {
        const bool is_own = next != part.end() && *next == element;
        next += is_own ? 1 : 0;
        if (is_own || meets_any(wider(boxes.subspan(6 * element, 6), tolerance), tree)) {
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

std::vector<double> in_order_of_elements(const Partition& partition, std::span<const double> by_part) {
    std::uint64_t n_elements = 0;
    for (std::uint32_t part = 0; part < partition.n_parts(); ++part) {
        n_elements += partition.n_elements(part);
    }
    const std::size_t size = n_elements > 0 ? by_part.size() / n_elements : 0;
    std::vector<double> ordered(by_part.size());
    for (std::uint32_t part = 0; part < partition.n_parts(); ++part) {
        for (const Span& run : partition.runs(part)) {
            std::ranges::copy(by_part.first(size * run.size()), std::span(ordered).subspan(size * run.first).begin());
            by_part = by_part.subspan(size * run.size());
        }
    }
    return ordered;
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
