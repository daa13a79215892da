#include <core/convert/face_points.hpp>

#include <algorithm>

namespace elvis {

OrientedFace oriented_face(native::Shape shape, int local_face, const std::array<std::int64_t, 8>& corner_numbers) {
    const std::span<const int> corners = native::face_corners(shape, local_face);
    const auto number = [&](int corner) { return corner_numbers[static_cast<std::size_t>(corner)]; };
    OrientedFace face;
    face.n_corners = static_cast<int>(corners.size());
    std::copy(corners.begin(), corners.end(), face.corners.begin());
    const auto first = face.corners.begin();
    const auto last = first + face.n_corners;
    if (face.n_corners == 4) {
        std::rotate(first, std::min_element(first, last, [&](int a, int b) { return number(a) < number(b); }), last);
        if (number(face.corners[3]) < number(face.corners[1])) {
            std::swap(face.corners[1], face.corners[3]);
        }
    } else {
        std::sort(first, last, [&](int a, int b) { return number(a) < number(b); });
    }
    face.key.fill(-1);
    for (int k = 0; k < face.n_corners; ++k) {
        face.key[static_cast<std::size_t>(k)] = number(face.corners[static_cast<std::size_t>(k)]);
    }
    std::sort(face.key.begin(), face.key.end());
    return face;
}

std::array<native::Point, n_face_points> face_points(native::Shape shape, const OrientedFace& face) {
    // Weights of the corners, one row a point.
    constexpr std::array<std::array<double, 2>, n_face_points> parameters = {
        {{0.5, 0.45}, {0.13, 0.21}, {0.84, 0.11}, {0.77, 0.83}, {0.19, 0.72}}};
    std::array<native::Point, n_face_points> points{};
    for (std::size_t point = 0; point < n_face_points; ++point) {
        const auto [u, v] = parameters[point];
        std::array<double, 4> weights{};
        if (face.n_corners == 2) {
            weights = {1 - u, u, 0, 0};
        } else if (face.n_corners == 3) {
            // The unit square onto the triangle, with all weights positive.
            weights = {(1 - u) * (1 - v), u * (1 - v), v, 0};
        } else {
            weights = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
        }
        for (int k = 0; k < face.n_corners; ++k) {
            const native::Point corner = native::corner(shape, face.corners[static_cast<std::size_t>(k)]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                points[point][axis] += weights[static_cast<std::size_t>(k)] * corner[axis];
            }
        }
    }
    return points;
}

} // namespace elvis
