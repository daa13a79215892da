/**
 * @file builder.hpp
 * Construction of the tree, apart from its use.
 */
#pragma once

#include <core/hierarchy/hierarchy.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** An item on its way into the tree: its box, rounded outward, and which one it is. Corners are loaded four numbers at once. */
struct alignas(16) HierarchyItem {
    std::array<float, 3> lower{};
    std::uint32_t index = 0;
    std::array<float, 3> upper{};
    std::uint32_t unused = 0;
};
static_assert(sizeof(HierarchyItem) == 32);

/** Reorders `items`; 2 * items.size() - 1 nodes, or none for no item. */
std::vector<HierarchyNode> build_hierarchy(std::vector<HierarchyItem>& items);

} // namespace elvis
