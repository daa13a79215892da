/**
 * @file face_points.hpp
 * Points on a face that both of its elements agree on, so that either can be evaluated there without knowing the other.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace elvis {

/** Corner numbers of a face, ascending, -1 in front for a triangle: the same from both sides. */
using FaceKey = std::array<std::int64_t, 4>;

/** A face of an element, with its corners in an order that depends on their numbers alone: two ends of an edge in two
 * dimensions. */
struct OrientedFace {
    FaceKey key{};
    /** Local corners of the element: of a quadrilateral round the face, from the lowest number towards its lower neighbour. */
    std::array<int, 4> corners{-1, -1, -1, -1};
    int n_corners = 0;
};

OrientedFace oriented_face(native::Shape shape, int local_face, const std::array<std::int64_t, 8>& corner_numbers);

inline constexpr std::size_t n_face_points = 5;

/** Reference coordinates of the face's points: inside it, without symmetry that could hide a wrong orientation. */
std::array<native::Point, n_face_points> face_points(native::Shape shape, const OrientedFace& face);

} // namespace elvis
