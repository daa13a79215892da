/**
 * @file tube_set.hpp
 * Round tubes about curves, such as streamlines.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <vector>

namespace elvis {

/** Pieces of curves; a tube is a round pipe about each piece, with a ball at each end. */
struct TubeSet {
    /** Ends of the piece before, of the piece itself, of the piece after: the first two or the last two are equal at ends. */
    using Piece = std::array<Vector3, 4>;

    std::vector<Piece> pieces;
    double radius = 0;

    /** Adds a curve through these points, of which there are at least two. */
    void add(const std::vector<Vector3>& points);
    /** min x y z, max x y z; of no pieces a box about the origin. */
    std::array<double, 6> bounds() const;
};

} // namespace elvis
