/**
 * @file mesh_distance.hpp
 * How far a mesh is from the surface that it stands for.
 */
#pragma once

#include <core/extract/merged_mesh.hpp>

namespace elvis {

struct MeshDistance {
    double mesh_to_surface = 0, surface_to_mesh = 0;
};

/** At points of every triangle, and of every side where the mesh ends. Cells that are off by more than `most` are wanted. */
MeshDistance measure_distance(const SurfaceSampler& sampler, CellMesh& cells, const MergedMesh& mesh, double most);

/** Faces of the element that a side of a triangle lies in, as bits; without the one that the surface is. */
std::uint32_t faces_of_side(const ElementCells& cells, const MergedTriangle& triangle, std::size_t side);

} // namespace elvis
