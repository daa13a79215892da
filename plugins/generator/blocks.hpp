/**
 * @file blocks.hpp
 * Meshes as blocks: smooth images of the unit cube, each cut into cells.
 */
#pragma once

#include "description.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace generator {

using Vector3 = std::array<double, 3>;

/** Faces of the cube (u, v, w) in [0,1]^3, in the order of a hexahedron's local faces: w-, v-, u+, v+, u-, w+. */
inline constexpr int n_cube_faces = 6;

struct Block {
    std::array<std::uint32_t, 3> n_cells{};
    /** Position of (u, v, w) in [0,1]^3. */
    std::function<Vector3(const Vector3&)> map;
    /** Boundary group of each face of the block, or -1 if it is inside the domain. */
    std::array<int, n_cube_faces> group{-1, -1, -1, -1, -1, -1};
    /** Part of the core of a mesh, around which layers in w lie: its shape mixture differs (see cells.hpp). */
    bool is_core = false;
    /** The last layer in w meets the first one. */
    bool is_periodic = false;
    /** The map is affine. */
    bool is_affine = false;
};

struct BlockMesh {
    std::vector<Block> blocks;
    std::vector<std::string> groups;
};

/**
 * The blocks of a mesh (all but twisted-tetrahedron).
 *   box          the box itself
 *   waves        the box's points q moved by 0.06 (sin pi q2 cos pi q3, sin pi q3 cos pi q1, sin pi q1 cos pi q2)
 *   ball         radius 1: a cube of half width 0.4 inside six blocks that reach to the sphere
 *   hemisphere   its half z >= 0
 *   shell        between radii 0.5 and 1: six blocks
 *   torus        radii 1 and 0.4 around z: a square of half width 0.16 inside four blocks, carried round
 */
BlockMesh make_blocks(const Description& description);

} // namespace generator
