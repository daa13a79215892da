/**
 * @file sections.hpp
 * Elements of an unstructured zone: its Elements_t.
 */
#pragma once

#include "base.hpp"
#include "element/element_type.hpp"

#include <functional>

namespace elvis_cgns {

/** Gets each element: its type by number, and its nodes, counted from 0 in the zone. */
using TakeElement = std::function<void(std::int64_t type, std::span<const std::uint32_t> nodes)>;

struct Section {
    Node node;
    /** Type of its elements, or mixed_number. */
    std::int64_t type = 0;
    /** Numbers of elements in the zone, from 1. */
    std::uint64_t first = 0;
    std::uint64_t last = 0;

    std::uint64_t n_elements() const { return last - first + 1; }
};

/** In the order of the elements' numbers. */
std::vector<Section> read_sections(Tree& tree, const Zone& zone);

void read_elements(Tree& tree, const Zone& zone, const Section& section, const TakeElement& take);

} // namespace elvis_cgns
