/**
 * @file element_blocks.hpp
 * Reference shapes as unions of hexahedra without collapsed corners.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <elvis/element.h>

#include <array>
#include <vector>

namespace elvis {

/** A part of a shape: the trilinear image of the cube [0,1]^3. */
struct ElementBlock {
    /** Of the corners of the cube, the first coordinate fastest. */
    std::array<Vector3, 8> corners{};

    /** xi(s), and how xi changes with each coordinate of s. */
    struct Place {
        Vector3 xi{};
        std::array<Vector3, 3> tangents{};
    };
    Place at(const Vector3& s) const;
};

/**
 * Hexahedra one block, prisms three, tetrahedra four, pyramids the eight of two tetrahedra. Blocks share whole faces. Of
 * quadrilaterals and triangles the plate between third coordinates 0 and 1.
 */
std::vector<ElementBlock> element_blocks(elvis_shape shape);

} // namespace elvis
