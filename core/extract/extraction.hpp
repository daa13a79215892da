/**
 * @file extraction.hpp
 * Meshes of isosurfaces, cut planes and boundaries, and contours on them, as near to the true ones as is wanted.
 *
 * Elements are divided in reference coordinates into tetrahedra (faces into triangles), which are halved at their longest edges
 * where the surface is not yet resolved. Vertices lie on the true surface. Points of neighbours are one where their positions
 * are equal but for rounding, and what is halved in one element is halved in all that share the edge: there are no cracks
 * where the field is continuous.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis {

struct ExtractionRequest {
    enum class Surface {
        boundary,   ///< faces without neighbour, of `groups` or of all; in two dimensions the elements, which are surfaces
        plane,      ///< a x + b y + c z + d = 0
        isosurface, ///< where `level_field` is `isovalue`
    };
    Surface surface = Surface::isosurface;
    std::vector<std::string> groups;
    std::array<double, 4> plane{};
    std::string level_field;
    double isovalue = 0;
    /** Instead of the surface: where on it this field or expression is one of these values. */
    std::string contour_field;
    std::vector<double> contours;
    std::uint32_t time_step = 0;
    /** How far mesh and surface may be from each other, as a share of the diagonal of the bounds. */
    double tolerance = 1e-3;
    std::uint64_t most_cells = 20'000'000;
};

struct SurfaceMesh {
    std::vector<Vector3> positions;
    /** Of length 1: to where the level is larger, or out of the volume; of surfaces in space that of their elements. */
    std::vector<Vector3> normals;
    /** An element that each vertex lies in, and where. */
    std::vector<ReferencePoint> places;
    /** Numbers of vertices, seen anticlockwise from where normals point; none where contours were asked for. */
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /** Of each triangle. */
    std::vector<std::uint64_t> elements;
    /** Contours: line i has vertices first[i] to first[i + 1] - 1, a closed one its first again as its last. */
    std::vector<std::uint32_t> line_vertices;
    std::vector<std::size_t> line_first;
    std::vector<double> line_values;

    /** Area, or length of contours. */
    double measure = 0;
    /** That the mesh encloses; of meaning where no edge is open. */
    double volume = 0;
    /** Largest distances seen, in world units: from the mesh to the surface, and back. */
    double mesh_to_surface = 0, surface_to_mesh = 0;
    /** What was asked for, in world units. */
    double tolerance = 0;
    /** Vertices - edges + triangles. */
    std::int64_t euler_number = 0;
    /**
     * Edges of one triangle alone: in the outer boundary, where the surface ends; and in the volume, where the field jumps or
     * elements do not meet face to face. Where the volume does not tell its faces, all count as inner ones.
     */
    std::uint64_t n_rim_edges = 0, n_inner_edges = 0;
    /** Of edges of more than two triangles. */
    std::uint64_t n_branching_edges = 0;
    /** Ends of contours within the surface. */
    std::uint64_t n_open_ends = 0;
    /** The plugin's bounds prove that no part of the surface that could hold a ball of the tolerance's diameter is missing. */
    bool is_certified = false;
    /** Elements for which samples stand for bounds; parts as small as the tolerance that stay undecided. */
    std::uint64_t n_sampled_elements = 0, n_undecided = 0;
    std::uint64_t n_elements = 0, n_cells = 0, n_evaluations = 0;
};

/** Throws Error for what cannot be extracted. The plugin has to evaluate on the CPU. */
SurfaceMesh extract(const RuntimeVolume& volume, const ExtractionRequest& request, const TaskControl& control);

} // namespace elvis
