/**
 * @file triangle_mesh.hpp
 * Surfaces made of triangles, from OBJ, STL and PLY files.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis {

struct TriangleMesh {
    std::string path;
    std::vector<Vector3> points;
    /** Indices of points; every triangle has three that exist. */
    std::vector<std::array<std::uint32_t, 3>> triangles;

    /** min x y z, max x y z of the triangles' corners. */
    std::array<double, 6> bounds() const;
};

/** Coordinates beyond this are refused: squares of differences must not overflow in single precision. */
inline constexpr double largest_mesh_coordinate = 1e15;

/**
 * Reads a file by its ending: .obj, .stl (text or binary), .ply (text or binary, either byte order). Polygons become fans of
 * triangles from their first corner. An Error names the file, the line or byte, and the cause; no damage to a file leads to
 * anything worse. At least one triangle.
 */
TriangleMesh read_triangle_mesh(const std::string& path);

} // namespace elvis
