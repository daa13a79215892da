/**
 * @file random_volumes.hpp
 * Small volumes with random fields on straight or strongly curved elements of all shapes, and views of their isosurfaces.
 */
#pragma once

#include "exact_volumes.hpp"

#include <core/render/frame.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::oracle {

struct RandomVolume {
    VolumeData data;
    /** Within the field's range, ascending. */
    std::vector<double> values;
    /** No half space, mostly. */
    std::vector<std::array<double, 4>> clip;
    /** Now and then inside the volume, or orthographic. */
    Camera camera;
    /** For people. */
    std::string description;
};

/**
 * The same volume for the same seed. Field orders 2 to 10; continuous fields are one polynomial in the coordinates of the mesh
 * before it is bent, discontinuous ones a polynomial for each element. The bend differs from the identity by a map whose
 * derivative is at most 0.75 in the 2-norm, so that it is one to one and keeps orientation.
 */
RandomVolume random_volume(std::uint64_t seed);

} // namespace elvis::oracle
