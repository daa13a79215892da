/**
 * @file ribbon_set.hpp
 * Flat bands along curves, such as streamlines, that turn about them.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <span>
#include <vector>

namespace elvis {

/** Pieces of ribbons, each the bilinear patch between two straight lines across its curve. */
struct RibbonSet {
    /** Two points across the curve where the piece begins, and two where it ends, on the same sides. */
    using Piece = std::array<Vector3, 4>;

    std::vector<Piece> pieces;
    double width = 0;

    /**
     * Adds a ribbon along a curve through these points, of which it lies in the directions `sides`, of length 1. It ends where
     * one of them is not finite.
     */
    void add(std::span<const Vector3> points, std::span<const Vector3> sides);
    /** min x y z, max x y z; of no pieces a box about the origin. */
    std::array<double, 6> bounds() const;
};

} // namespace elvis
