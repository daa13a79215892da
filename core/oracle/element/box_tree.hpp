/**
 * @file box_tree.hpp
 * Finds the boxes that hold a point: a plain median-split tree, unrelated to the hierarchies of the core.
 */
#pragma once

#include "enclosure.hpp"

#include <cstdint>
#include <vector>

namespace elvis::oracle {

class BoxTree {
public:
    explicit BoxTree(const std::vector<Enclosure>& enclosures);

    /** Elements whose box comes within `tolerance` of x, ascending. */
    std::vector<std::size_t> find(const Vector& x, double tolerance) const;

    const Vector& lower() const { return m_nodes.front().lower; }
    const Vector& upper() const { return m_nodes.front().upper; }

private:
    struct Node {
        Vector lower;
        Vector upper;
        std::size_t first; ///< items first .. last-1 of m_items
        std::size_t last;
        std::size_t second_child; ///< 0: leaf; the first child follows its parent
    };
    void build(const std::vector<Enclosure>& enclosures, std::size_t first, std::size_t last);
    void find(std::size_t node, const Vector& x, double tolerance, std::vector<std::size_t>& found) const;

    const std::vector<Enclosure>* m_enclosures;
    std::vector<std::size_t> m_items;
    std::vector<Node> m_nodes;
};

} // namespace elvis::oracle
