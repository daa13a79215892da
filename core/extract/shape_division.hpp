/**
 * @file shape_division.hpp
 * Reference shapes as sets of simplices, and their faces as planes.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <elvis/element.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Faces of a shape (edges, in two dimensions), in the order of elvis/element.h: normal . xi = offset, normals point out. */
struct ShapeFaces {
    std::vector<Vector3> normals;
    std::vector<double> offsets;

    /** Bit i: the point is in the plane of face i, but for rounding. */
    std::uint32_t holding(const Vector3& xi) const;
};
const ShapeFaces& shape_faces(elvis_shape shape);

/** Corners, and the centroid of hexahedra and prisms behind them. */
std::vector<Vector3> division_points(elvis_shape shape);

/**
 * Tetrahedra of division_points, positively oriented, or triangles of a two-dimensional shape. `ids`: of the points; a
 * quadrilateral is divided from the corner with the smallest, so that both of its elements do the same.
 */
std::vector<std::array<std::uint32_t, 4>> divide_shape(elvis_shape shape, std::span<const std::uint32_t> ids);
/** Triangles of a face of a solid, seen anticlockwise from outside in reference coordinates. The fourth number is unused. */
std::vector<std::array<std::uint32_t, 4>> divide_face(elvis_shape shape, int local_face, std::span<const std::uint32_t> ids);

} // namespace elvis
