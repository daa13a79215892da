#include <core/convert/topology/face_points.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace elvis {

namespace {

/** Weights of a face's corners at each point. */
using Weights = std::vector<std::array<double, 4>>;

Weights quadrilateral_weights() {
    // A point with no symmetry, well inside; its images under the symmetries of the square.
    constexpr double a = 0.85, b = 0.35;
    std::vector<std::array<double, 2>> points = {{-1, -1}, {1, -1}, {1, 1},   {-1, 1}, {0, 0}, {-a, -b}, {a, -b},
                                                 {a, b},   {-a, b}, {-b, -a}, {b, -a}, {b, a}, {-b, a}};
    Weights weights;
    for (const auto& [u, v] : points) {
        weights.push_back({(1 - u) * (1 - v) / 4, (1 + u) * (1 - v) / 4, (1 + u) * (1 + v) / 4, (1 - u) * (1 + v) / 4});
    }
    return weights;
}

Weights triangle_weights() {
    constexpr double a = 0.6, b = 0.3, c = 0.1;
    constexpr double third = 1.0 / 3;
    return {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {third, third, third, 0}, {a, b, c, 0}, {a, c, b, 0}, {b, a, c, 0},
            {b, c, a, 0}, {c, a, b, 0}, {c, b, a, 0}};
}

/** The edge of a two-dimensional element. */
Weights edge_weights() {
    constexpr double a = 0.85, b = 0.15;
    return {{1, 0, 0, 0}, {0, 1, 0, 0}, {0.5, 0.5, 0, 0}, {a, b, 0, 0}, {b, a, 0, 0}};
}

const Weights& weights_of(std::size_t n_corners) {
    static const Weights quadrilateral = quadrilateral_weights();
    static const Weights triangle = triangle_weights();
    static const Weights edge = edge_weights();
    return n_corners == 4 ? quadrilateral : n_corners == 3 ? triangle : edge;
}

using Order = std::vector<std::uint8_t>;

/** Where each point goes when corner k of the agreed order is corner corners[k] of the face. */
Order permuted(const std::vector<std::size_t>& corners) {
    const Weights& weights = weights_of(corners.size());
    Order order;
    for (const std::array<double, 4>& agreed : weights) {
        std::array<double, 4> local{};
        for (std::size_t k = 0; k < corners.size(); ++k) {
            local[corners[k]] = agreed[k];
        }
        const auto found = std::ranges::find_if(weights, [&](const std::array<double, 4>& candidate) {
            return std::ranges::equal(candidate, local, [](double x, double y) { return std::abs(x - y) < 1e-12; });
        });
        assert(found != weights.end());
        order.push_back(static_cast<std::uint8_t>(found - weights.begin()));
    }
    return order;
}

/** All ways to order the corners of a quadrilateral round the face, by 2 * first + (backwards). */
std::array<Order, 8> quadrilateral_orders() {
    std::array<Order, 8> orders;
    for (std::size_t first = 0; first < 4; ++first) {
        orders[2 * first] = permuted({first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4});
        orders[2 * first + 1] = permuted({first, (first + 3) % 4, (first + 2) % 4, (first + 1) % 4});
    }
    return orders;
}

/** All ways to order the corners of a triangle, by 3 * first + second. */
std::array<Order, 9> triangle_orders() {
    std::array<Order, 9> orders;
    for (std::size_t first = 0; first < 3; ++first) {
        for (std::size_t second = 0; second < 3; ++second) {
            if (first != second) {
                orders[3 * first + second] = permuted({first, second, 3 - first - second});
            }
        }
    }
    return orders;
}

/** Both ways to order the corners of an edge, by which comes first. */
std::array<Order, 2> edge_orders() { return {permuted({0, 1}), permuted({1, 0})}; }

} // namespace

FaceKey face_key(native::Shape shape, int local_face, const CornerNumbers& corners) {
    FaceKey key;
    key.fill(no_corner);
    std::size_t n = 0;
    for (const int corner : native::face_corners(shape, local_face)) {
        key[n++] = corners[static_cast<std::size_t>(corner)];
    }
    std::ranges::sort(key);
    return key;
}

FacePoints::FacePoints(native::Shape shape) : m_shape(shape) {
    for (int face = 0; face < native::n_faces(shape); ++face) {
        m_first.push_back(n_points());
        const std::span<const int> corners = native::face_corners(shape, face);
        for (const std::array<double, 4>& weights : weights_of(corners.size())) {
            native::Point point{};
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const native::Point corner = native::corner(shape, corners[k]);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    point[axis] += weights[k] * corner[axis];
                }
            }
            m_xi.insert(m_xi.end(), point.begin(), point.end());
        }
    }
    m_first.push_back(n_points());
}

std::span<const std::uint8_t> FacePoints::order(int local_face, const CornerNumbers& corners) const {
    static const std::array<Order, 8> quadrilaterals = quadrilateral_orders();
    static const std::array<Order, 9> triangles = triangle_orders();
    const std::span<const int> face = native::face_corners(m_shape, local_face);
    const auto number = [&](std::size_t k) { return corners[static_cast<std::size_t>(face[k % face.size()])]; };
    std::size_t first = 0;
    for (std::size_t k = 1; k < face.size(); ++k) {
        first = number(k) < number(first) ? k : first;
    }
    if (face.size() == 2) {
        static const std::array<Order, 2> edges = edge_orders();
        return edges[first];
    }
    const bool is_backwards = number(first + face.size() - 1) < number(first + 1);
    if (face.size() == 4) {
        return quadrilaterals[2 * first + (is_backwards ? 1 : 0)];
    }
    return triangles[3 * first + (first + (is_backwards ? 2 : 1)) % 3];
}

std::array<FacePoints, native::n_shapes> all_face_points() {
    return {FacePoints(native::Shape::hexahedron),    FacePoints(native::Shape::prism),
            FacePoints(native::Shape::pyramid),       FacePoints(native::Shape::tetrahedron),
            FacePoints(native::Shape::quadrilateral), FacePoints(native::Shape::triangle)};
}

} // namespace elvis
