/**
 * @file arrow_set.hpp
 * Arrows: a round shaft and a cone as its head, of the same proportions at any length.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace elvis {

struct ArrowSet {
    struct Arrow {
        Vector3 from{}, to{}; ///< not equal
        /** What its colour stands for. */
        double value = 0;
        /** Of the element in which it begins, as people know it. */
        std::uint32_t number = 0;
    };

    /** Shares of an arrow's length. */
    static constexpr double shaft_radius = 0.05, head_radius = 0.14, head_length = 0.35;

    std::vector<Arrow> arrows;

    /** min x y z, max x y z; of no arrows a box about the origin. */
    std::array<double, 6> bounds() const;
};

/** A box that holds the arrow. */
std::array<double, 6> bounds_of(const ArrowSet::Arrow& arrow);

} // namespace elvis
