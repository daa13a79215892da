/**
 * @file mesh.hpp
 * Blocks, nodes and side sets of an Exodus II file as elements and groups of faces.
 */
#pragma once

#include "block_type.hpp"
#include "netcdf/netcdf.hpp"

#include <elvis/plugin.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace elvis_exodus {

/** A block of elements of one type. */
struct Block {
    std::string name;
    ElementType type;
    /** Of two dimensions in space. */
    bool is_shell = false;
    /** Which of the file's blocks it is, from 1. */
    std::size_t number = 0;
    /** Its first element, among those that are read; and among all of the file, by which side sets count. */
    std::uint64_t first_element = 0, first_in_file = 0;
    std::uint64_t n_elements = 0;
    /** Nodes of all its elements in CGNS's order, counted from 0. */
    std::vector<std::uint32_t> nodes;
};

/** Kept in memory. Any thread may ask. */
class Mesh {
public:
    /** Blocks of fewer dimensions than the largest are left out, with a warning. */
    Mesh(const NetCdf& file, const elvis::api::Host& host);

    std::uint32_t dimension() const { return m_dimension; }
    std::uint64_t n_elements() const { return m_n_elements; }
    std::uint64_t n_nodes() const { return m_points.size() / 3; }
    std::uint32_t mantissa_bits() const { return m_mantissa_bits; }
    const std::vector<Block>& blocks() const { return m_blocks; }
    const Block& block_of(std::uint64_t element) const;
    std::span<const std::uint32_t> nodes(std::uint64_t element) const;
    /** Three numbers. */
    const double* point(std::uint32_t node) const { return &m_points[3 * std::size_t{node}]; }

    const std::vector<std::string>& groups() const { return m_groups; }
    /** Of a local face of elvis/element.h; ELVIS_GROUP_NONE where there is none. */
    std::int32_t face_group(std::uint64_t element, int face) const;

private:
    void read_points(const NetCdf& file);
    void read_blocks(const NetCdf& file, const elvis::api::Host& host);
    void read_connectivity(const NetCdf& file, Block& block);
    void read_side_sets(const NetCdf& file);
    /** Adds a side to a group; nothing if its element is not read. */
    void add_side(const NetCdf& file, std::int64_t element, std::int64_t side, std::int32_t group);

    std::uint32_t m_dimension = 3;
    std::vector<double> m_points;
    std::uint32_t m_mantissa_bits = 53;
    std::vector<Block> m_blocks;
    std::uint64_t m_n_elements = 0, m_n_in_file = 0;
    std::vector<std::string> m_groups;
    /** By 8 * element + face. */
    std::unordered_map<std::uint64_t, std::int32_t> m_face_groups;
};

} // namespace elvis_exodus
