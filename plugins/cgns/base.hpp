/**
 * @file base.hpp
 * Which part of a file is read: a base, its zones, and where their coordinates lie.
 */
#pragma once

#include "container/tree.hpp"

#include <elvis/plugin.hpp>

#include <array>

namespace elvis_cgns {

struct Zone {
    Node node;
    bool is_structured = false;
    /** Structured zones have as many indices as the base has dimensions, others one. */
    std::size_t n_indices = 1;
    /** By index. */
    std::array<std::uint64_t, 3> n_vertices{1, 1, 1};
    std::array<std::uint64_t, 3> n_cells{1, 1, 1};

    std::uint64_t n_all_vertices() const { return n_vertices[0] * n_vertices[1] * n_vertices[2]; }
    std::uint64_t n_all_cells() const { return n_cells[0] * n_cells[1] * n_cells[2]; }
};

struct Base {
    Node node;
    /** Of the cells, 2 or 3. */
    std::uint32_t dimension = 3;
    /** Number of coordinates, 2 or 3. */
    std::uint32_t n_coordinates = 3;
    std::vector<Zone> zones;
};

/** The base of the most dimensions, the first one by name; a warning names the others. */
Base read_base(Tree& tree, const elvis::api::Host& host);

/** Where values lie that a node gives: GridLocation of the node, by default "Vertex". */
std::string grid_location(Tree& tree, const Node& node);

/**
 * Numbers of an array of a zone, as many as `extents` say, without the rind planes that `parent` has around them.
 */
std::vector<double> read_array(Tree& tree, const Node& parent, const Node& array, const Zone& zone,
                               const std::array<std::uint64_t, 3>& extents);

/** Significant bits of the numbers in an array. */
std::uint32_t mantissa_bits(const Node& array);

} // namespace elvis_cgns
