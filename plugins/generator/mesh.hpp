/**
 * @file mesh.hpp
 * The topology of generated meshes: elements, corners and boundary groups by arithmetic, nothing stored per element.
 *
 * Every mesh is a core, a lattice of n1 x n2 x n3 cells, wrapped in layers of cells that grow outward from some of its sides;
 * each part may be missing. A box is a core alone, a spherical shell is layers alone, a ball is both.
 */
#pragma once

#include "cell_split.hpp"
#include "parameters.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace generator {

/** A place in the mesh: u in [0,1]^3 within the core or on its surface; t in [0,1] counts through the layers, 0 in the core. */
struct LatticePoint {
    Vec3 u{};
    double t = 0;
};

/** A run of cells that are cut in the same way. */
struct Block {
    /** Lattice direction of each of the cells' directions; 3 is through the layers. */
    std::array<int, 3> directions{0, 1, 2};
    /** Side of the core on which these layers lie, 2 d + (u_d == 1), or -1 in the core. */
    int side = -1;
    std::array<std::uint32_t, 3> start{};
    std::array<std::uint32_t, 3> count{};
    CellSplit split;
    std::uint64_t first_element = 0;
    /** Counted over the whole mesh. */
    std::uint64_t first_cell = 0;
    /** Boundary group on each side of the block, or ELVIS_GROUP_NONE. */
    std::array<std::int32_t, 6> groups{-1, -1, -1, -1, -1, -1};
};

struct ElementPlace {
    const Block* block = nullptr;
    const SubElement* element = nullptr;
    std::array<std::uint32_t, 3> cell{};
    std::uint64_t cell_number = 0;
};

class Mesh {
public:
    explicit Mesh(const Parameters& parameters);

    std::uint64_t n_elements() const { return m_n_elements; }
    std::uint64_t n_corner_ids() const;
    const std::vector<std::string>& groups() const { return m_groups; }

    ElementPlace place(std::uint64_t element) const;
    std::int64_t corner_id(const ElementPlace& place, CellCorner corner) const;
    std::int32_t group(const ElementPlace& place, std::size_t local_face) const;
    /** Where a reference point of an element lies. */
    LatticePoint lattice_point(const ElementPlace& place, const double* xi) const;

private:
    void add_core(const Parameters& parameters);
    void add_slabs(const Block& whole);
    void add_layers(const Parameters& parameters, int side);
    void add_block(Block block);
    std::uint64_t n_lattice_corners() const;

    std::array<std::uint32_t, 3> m_cells{};
    std::uint32_t m_layers = 0;
    /** Whether the third direction closes on itself. */
    bool m_is_ring = false;
    std::vector<Block> m_blocks;
    std::vector<std::string> m_groups;
    std::uint64_t m_n_elements = 0;
    std::uint64_t m_n_cells = 0;
};

} // namespace generator
