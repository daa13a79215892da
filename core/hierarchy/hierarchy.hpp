/**
 * @file hierarchy.hpp
 * Bounding volume hierarchy over axis-aligned boxes: what point location and rays descend through, on the CPU and on the
 * device.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/**
 * One node of the binary tree, in the layout the device reads (32 bytes, two rows of four words). Bounds are relative to
 * Hierarchy::centre() and rounded outward, so that single precision never loses a point that lies in the box.
 */
struct HierarchyNode {
    std::array<float, 3> lower{};
    /** Inner node: index of the first child; the second one follows it. Leaf: the item. */
    std::uint32_t child = 0;
    std::array<float, 3> upper{};
    /** 0: inner node. 1: leaf (every leaf holds one item). */
    std::uint32_t n_items = 0;

    bool is_leaf() const { return n_items != 0; }
};
static_assert(sizeof(HierarchyNode) == 32);

/** Nodes as records of words for the device, node_size words each. */
inline constexpr std::uint32_t node_size = sizeof(HierarchyNode) / sizeof(std::uint32_t);
std::vector<std::uint32_t> node_words(std::span<const HierarchyNode> nodes);

/**
 * Built once over the boxes of items 0 .. n-1 (elements of one class, faces), then read-only; any number of threads may query
 * it. Children come after their parent in nodes(); node 0 is the root. No node is deeper than max_depth.
 */
class Hierarchy {
public:
    /** Steps from the root to the deepest leaf that any tree can have: the size of a traversal stack. */
    static constexpr std::uint32_t max_depth = 60;

    /** No item, no node. */
    Hierarchy() = default;

    /**
     * `boxes`: six finite numbers an item, min x y z then max x y z, min <= max and no
     * coordinate beyond 1e18; fewer than 2^31 items. `centre`: where the
     * nodes' bounds are relative to, best the centre of the whole volume. Binned surface area heuristic (Wald, "On fast
     * construction of SAH-based bounding volume hierarchies", 2007), on two threads where there are enough items.
     */
    Hierarchy(std::span<const double> boxes, const Vector3& centre);

    std::span<const HierarchyNode> nodes() const { return m_nodes; }
    const Vector3& centre() const { return m_centre; }
    std::uint32_t n_items() const { return m_n_items; }
    /** Steps from the root to the deepest leaf. */
    std::uint32_t depth() const;

    /**
     * Appends to `items` every item whose box comes within `tolerance` of the point (in each coordinate), in no particular
     * order. Boxes are rounded outward: an item may be reported that misses by an ulp of single precision.
     */
    void find(const Vector3& point, double tolerance, std::vector<std::uint32_t>& items) const;

private:
    Vector3 m_centre{};
    std::uint32_t m_n_items = 0;
    std::vector<HierarchyNode> m_nodes;
};

} // namespace elvis
