/**
 * @file line_nodes.hpp
 * Nodes on [-1, 1] and their tensor products.
 */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace elvis_hopr {

/** Highest order that is read: 2197 nodes an element, whose matrix is inverted in seconds. */
inline constexpr std::uint32_t most_order = 12;

/** -1 + 2 i / order. */
std::vector<double> equidistant_nodes(std::uint32_t order);

/** Nodes of a state's attribute NodeType; empty if there is no such type. */
std::vector<double> line_nodes(const std::string& type, std::uint32_t order);

/** Three coordinates each, i fastest, then j, then k. */
std::vector<double> cube_of(const std::vector<double>& line);

} // namespace elvis_hopr
