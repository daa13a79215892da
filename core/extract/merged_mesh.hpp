/**
 * @file merged_mesh.hpp
 * Triangles of all elements as one mesh.
 */
#pragma once

#include <core/extract/cell_mesh.hpp>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace elvis {

/** A point of an element. */
struct LocalPoint {
    std::uint32_t element = 0, point = 0;
};

struct MergedTriangle {
    /** Places in CellMesh::elements() and in the element's cells. */
    std::uint32_t element = 0, cell = 0;
    CellTriangle points{};
    std::array<std::uint32_t, 3> vertices{};
};

/** One side of one triangle. */
struct TriangleSide {
    std::uint32_t triangle = 0, side = 0;
};

struct MergedEdge {
    static constexpr std::uint32_t none = 0xffffffffu;
    /** Of at most two triangles; how many there are. */
    std::array<TriangleSide, 2> sides{{{none, 0}, {none, 0}}};
    std::uint32_t n_triangles = 0;
};

struct MergedMesh {
    /** Of each vertex the first point that is there. */
    std::vector<LocalPoint> vertices;
    std::vector<MergedTriangle> triangles;
    /** By pairs of vertices. */
    std::unordered_map<std::uint64_t, MergedEdge> edges;

    const CellPoint& point(const CellMesh& cells, std::uint32_t vertex) const {
        return cells.elements()[vertices[vertex].element].points()[vertices[vertex].point];
    }
};

/** Places on an edge that are nearer to each other than `distance` are one vertex. */
MergedMesh merge_triangles(const CellMesh& cells, double distance);

} // namespace elvis
