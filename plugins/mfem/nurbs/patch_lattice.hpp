/**
 * @file patch_lattice.hpp
 * Numbers of lattice points on patches that share vertices, edges and faces: MFEM's order of control points, and of the
 * vertices that knots make.
 */
#pragma once

#include "../mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis_mfem {

/** Points along the three directions of a patch; 1 in the third of the plane. */
using LatticeSize = std::array<int, 3>;

struct PatchLattices {
    /** By patch, first direction fastest. */
    std::vector<std::vector<std::int32_t>> numbers;
    std::size_t n_numbers = 0;
};

/**
 * Numbers the vertices of the patches first, then the inner points of edges (in the order given, from the lower vertex to the
 * higher), faces (as the patches meet them, in the order of vertices that the first has) and patches. Throws
 * std::invalid_argument if patches disagree.
 */
PatchLattices number_lattices(const Mesh& patches, std::span<const std::array<std::int32_t, 2>> edges,
                              std::span<const LatticeSize> sizes);

} // namespace elvis_mfem
