/**
 * @file geometry.hpp
 * MFEM's reference elements: vertices, edges and faces in its order, and the map from ElVis's reference shapes.
 *
 * Source: MFEM, fem/geom.hpp and fem/geom.cpp (Geometry::Constants). Tables: format.md.
 */
#pragma once

#include <elvis/element.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace elvis_mfem {

using Point = std::array<double, 3>;

/** Numbers as in the files. */
enum class Geometry : std::uint8_t { triangle = 2, square = 3, tetrahedron = 4, cube = 5, prism = 6, pyramid = 7 };

inline constexpr std::array all_geometries{Geometry::triangle, Geometry::square, Geometry::tetrahedron,
                                           Geometry::cube,     Geometry::prism,  Geometry::pyramid};

/** A face by its vertices; the fourth is -1 in triangles. */
using FaceVertices = std::array<int, 4>;

inline int n_corners(const FaceVertices& face) { return face[3] < 0 ? 3 : 4; }

/** 2 or 3. */
inline int dimension(Geometry geometry) { return geometry <= Geometry::square ? 2 : 3; }

/** In two dimensions the third coordinate is 0. */
std::span<const Point> vertices(Geometry geometry);
std::span<const std::array<int, 2>> edges(Geometry geometry);
/** None in two dimensions. */
std::span<const FaceVertices> faces(Geometry geometry);

elvis_shape shape(Geometry geometry);
/** The MFEM vertex at each corner of the ElVis shape. */
std::span<const int> corner_vertices(Geometry geometry);

/**
 * MFEM's reference point of an ElVis reference point. The map is affine, of positive determinant, and 1/2 times a rotation.
 * Prisms: x = (1 + xi1)/2, y = (1 + xi3)/2, z = (1 - xi2)/2; all others X = (1 + xi)/2.
 */
Point to_mfem(Geometry geometry, const double* xi);
/** A vector of MFEM's reference frame in ElVis's axes, by the rotation alone. */
Point rotate_to_elvis(Geometry geometry, const Point& vector);

} // namespace elvis_mfem
