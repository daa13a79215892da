/**
 * @file face_points.hpp
 * Points on faces at which the two sides of a face are compared.
 *
 * Each face has the same points whatever element it is seen from: the set is mapped onto itself by every symmetry of the face,
 * and an order of the points that depends only on the numbers of the face's corners says which point of one side is which of
 * the other. So either side can be evaluated without knowing the other, and always at the same reference points.
 */
#pragma once

#include <core/convert/topology/corners.hpp>
#include <elvis/native/space.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Points of a quadrilateral: corners, centre, and the eight images of a point without symmetry; of a triangle three, one, six;
 * of the edge of a two-dimensional element two, one, two. The centre comes after the corners. */
inline std::size_t centre_of_face(std::size_t n_points) { return n_points == 13 ? 4 : n_points == 10 ? 3 : 2; }

/** Sorted corner numbers, no_corner at the end for triangles and edges: the same from both sides. */
using FaceKey = std::array<std::uint32_t, 4>;
FaceKey face_key(native::Shape shape, int local_face, const CornerNumbers& corners);

/** The points of all faces of a shape, face after face. */
class FacePoints {
public:
    explicit FacePoints(native::Shape shape);

    /** Reference coordinates, three numbers a point. */
    const std::vector<double>& xi() const { return m_xi; }
    std::size_t n_points() const { return m_xi.size() / 3; }
    std::size_t first_point(int local_face) const { return m_first[static_cast<std::size_t>(local_face)]; }
    std::size_t n_points(int local_face) const { return first_point(local_face + 1) - first_point(local_face); }

    /**
     * The order that both sides agree on: entry p is the point, among those of the local face, that comes at place p. Points 0
     * .. (number of corners) - 1 are corners; the next one is the centre.
     */
    std::span<const std::uint8_t> order(int local_face, const CornerNumbers& corners) const;

private:
    native::Shape m_shape;
    std::vector<double> m_xi;
    std::vector<std::size_t> m_first;
};

/** By shape. */
std::array<FacePoints, native::n_shapes> all_face_points();

} // namespace elvis
