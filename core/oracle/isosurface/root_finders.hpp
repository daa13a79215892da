/**
 * @file root_finders.hpp
 * The oracle's three ways to find crossings of isosurfaces against each other.
 */
#pragma once

#include "isosurface.hpp"

#include <cstdint>

namespace elvis::oracle {

struct FinderComparison {
    /** Rays, and those on which the series has a crossing. */
    std::size_t n_rays = 0, n_hits = 0;
    /** Rays on which another way finds no crossing, one more, another element or another isovalue. */
    std::size_t n_samples_differ = 0, n_companion_differ = 0;
    /** Largest |field| between two crossings of one ray, to first order, over the field's range. */
    double samples_error = 0, companion_error = 0;
    std::uint64_t n_failures = 0;

    FinderComparison& operator+=(const FinderComparison& other);
};

/** On every `stride`-th pixel of a picture, by as many threads as the machine has cores. */
FinderComparison compare_finders(const Model& model, const Isosurface& isosurface, const Camera& camera, std::uint32_t width,
                                 std::uint32_t height, std::uint32_t stride = 1);

} // namespace elvis::oracle
