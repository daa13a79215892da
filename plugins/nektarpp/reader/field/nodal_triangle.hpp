/**
 * @file nodal_triangle.hpp
 * Points on the reference triangle at which curved faces are given.
 */
#pragma once

#include "../geometry/geometry_data.hpp"

#include <optional>

namespace nektarpp {

/** Reference coordinates of a point of the triangle (-1,-1) (1,-1) (-1,1). */
using TrianglePoint = std::array<double, 2>;

/**
 * The points of a triangular set with n points along an edge, n(n+1)/2 of them: three corners, the inner points of the edges
 * 01, 12, 20, then the interior. None if there is no such set: electrostatic points end at n = 12, and so do Fekete points,
 * which lack n = 11.
 */
std::optional<std::vector<TrianglePoint>> triangle_points(PointSet set, std::uint32_t n);

} // namespace nektarpp
