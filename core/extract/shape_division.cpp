#include <core/extract/shape_division.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace elvis {

namespace {

using Corners = std::array<std::uint32_t, 4>;
constexpr std::size_t n_known_shapes = native::n_shapes;

Vector3 corner_of(elvis_shape shape, int index) { return native::corner(native::Shape{shape}, index); }

Vector3 mean_corner(elvis_shape shape) {
    Vector3 sum{};
    const int n = native::n_corners(native::Shape{shape});
    for (int index = 0; index < n; ++index) {
        sum = plus(sum, corner_of(shape, index));
    }
    return scaled(sum, 1.0 / n);
}

ShapeFaces make_faces(elvis_shape shape) {
    const native::Shape native_shape{shape};
    const Vector3 middle = mean_corner(shape);
    ShapeFaces faces;
    for (int face = 0; face < native::n_faces(native_shape); ++face) {
        const auto corners = native::face_corners(native_shape, face);
        const Vector3 first = corner_of(shape, corners[0]), along = minus(corner_of(shape, corners[1]), first);
        const Vector3 across =
            native::dimension(native_shape) == 2 ? Vector3{0, 0, 1} : minus(corner_of(shape, corners[2]), first);
        Vector3 normal = unit(cross(along, across));
        normal = dot(normal, minus(first, middle)) < 0 ? scaled(normal, -1) : normal;
        faces.normals.push_back(normal);
        faces.offsets.push_back(dot(normal, first));
    }
    return faces;
}

/** A face of three or four corners. */
std::vector<std::array<std::uint32_t, 3>> triangles_of(std::span<const int> corners, std::span<const std::uint32_t> ids) {
    std::vector<std::uint32_t> c(corners.begin(), corners.end());
    if (c.size() == 3) {
        return {{c[0], c[1], c[2]}};
    }
    const auto least = std::ranges::min_element(c, {}, [&](std::uint32_t corner) { return ids[corner]; });
    std::rotate(c.begin(), least, c.end());
    return {{c[0], c[1], c[2]}, {c[0], c[2], c[3]}};
}

double orientation(const std::vector<Vector3>& points, const Corners& cell) {
    const Vector3& origin = points[cell[0]];
    return dot(minus(points[cell[1]], origin), cross(minus(points[cell[2]], origin), minus(points[cell[3]], origin)));
}

/** Tetrahedra between a point and those faces that do not have it. */
std::vector<Corners> cone(elvis_shape shape, std::uint32_t tip, std::span<const std::uint32_t> ids) {
    const native::Shape native_shape{shape};
    const std::vector<Vector3> points = division_points(shape);
    std::vector<Corners> cells;
    for (int face = 0; face < native::n_faces(native_shape); ++face) {
        const auto corners = native::face_corners(native_shape, face);
        if (std::ranges::find(corners, static_cast<int>(tip)) != corners.end()) {
            continue;
        }
        for (const auto& [a, b, c] : triangles_of(corners, ids)) {
            Corners cell{tip, a, b, c};
            if (orientation(points, cell) < 0) {
                std::swap(cell[2], cell[3]);
            }
            cells.push_back(cell);
        }
    }
    return cells;
}

} // namespace

std::uint32_t ShapeFaces::holding(const Vector3& xi) const {
    // Points of faces are means of others, so that rounding alone takes them off.
    constexpr double rounding = 1e-12;
    std::uint32_t faces = 0;
    for (std::size_t face = 0; face < normals.size(); ++face) {
        faces |= std::abs(dot(normals[face], xi) - offsets[face]) < rounding ? 1u << face : 0u;
    }
    return faces;
}

const ShapeFaces& shape_faces(elvis_shape shape) {
    static const std::array<ShapeFaces, n_known_shapes> all = [] {
        std::array<ShapeFaces, n_known_shapes> made;
        for (std::uint32_t index = 0; index < n_known_shapes; ++index) {
            made[index] = make_faces(index);
        }
        return made;
    }();
    return all[shape];
}

std::vector<Vector3> division_points(elvis_shape shape) {
    std::vector<Vector3> points;
    for (int index = 0; index < native::n_corners(native::Shape{shape}); ++index) {
        points.push_back(corner_of(shape, index));
    }
    if (shape == ELVIS_SHAPE_HEXAHEDRON || shape == ELVIS_SHAPE_PRISM) {
        points.push_back(mean_corner(shape));
    }
    return points;
}

std::vector<Corners> divide_shape(elvis_shape shape, std::span<const std::uint32_t> ids) {
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return cone(shape, 8, ids);
    case ELVIS_SHAPE_PRISM:
        return cone(shape, 6, ids);
    case ELVIS_SHAPE_PYRAMID:
        return cone(shape, 4, ids);
    case ELVIS_SHAPE_TETRAHEDRON:
        return {{0, 1, 2, 3}};
    case ELVIS_SHAPE_TRIANGLE:
        return {{0, 1, 2, 0}};
    default: {
        std::vector<Corners> cells;
        constexpr std::array<int, 4> around{0, 1, 2, 3};
        for (const auto& [a, b, c] : triangles_of(around, ids)) {
            cells.push_back({a, b, c, 0});
        }
        return cells;
    }
    }
}

std::vector<Corners> divide_face(elvis_shape shape, int local_face, std::span<const std::uint32_t> ids) {
    const std::vector<Vector3> points = division_points(shape);
    const Vector3& outward = shape_faces(shape).normals[static_cast<std::size_t>(local_face)];
    std::vector<Corners> cells;
    for (auto [a, b, c] : triangles_of(native::face_corners(native::Shape{shape}, local_face), ids)) {
        const Vector3 area = cross(minus(points[b], points[a]), minus(points[c], points[a]));
        if (dot(area, outward) < 0) {
            std::swap(b, c);
        }
        cells.push_back({a, b, c, 0});
    }
    return cells;
}

} // namespace elvis
