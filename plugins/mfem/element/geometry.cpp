#include "geometry.hpp"

namespace elvis_mfem {

namespace {

constexpr Point cube_vertices[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
constexpr Point tetrahedron_vertices[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr Point prism_vertices[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
constexpr Point pyramid_vertices[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};

constexpr std::array<int, 2> cube_edges[] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6},
                                             {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr std::array<int, 2> tetrahedron_edges[] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr std::array<int, 2> prism_edges[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
constexpr std::array<int, 2> pyramid_edges[] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};

constexpr FaceVertices cube_faces[] = {{3, 2, 1, 0}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
constexpr FaceVertices tetrahedron_faces[] = {{1, 2, 3, -1}, {0, 3, 2, -1}, {0, 1, 3, -1}, {0, 2, 1, -1}};
constexpr FaceVertices prism_faces[] = {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr FaceVertices pyramid_faces[] = {{3, 2, 1, 0}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};

constexpr int same_corners[] = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr int prism_corners[] = {3, 4, 1, 0, 5, 2};

template <class Cube, class Tetrahedron, class Prism, class Pyramid>
auto choose(Geometry geometry, const Cube& cube, const Tetrahedron& tetrahedron, const Prism& prism, const Pyramid& pyramid) {
    using Result = std::span<const typename std::remove_cvref_t<decltype(cube[0])>>;
    switch (geometry) {
    case Geometry::cube:
        return Result(cube);
    case Geometry::tetrahedron:
        return Result(tetrahedron);
    case Geometry::prism:
        return Result(prism);
    default:
        return Result(pyramid);
    }
}

} // namespace

std::span<const Point> vertices(Geometry geometry) {
    return choose(geometry, cube_vertices, tetrahedron_vertices, prism_vertices, pyramid_vertices);
}

std::span<const std::array<int, 2>> edges(Geometry geometry) {
    return choose(geometry, cube_edges, tetrahedron_edges, prism_edges, pyramid_edges);
}

std::span<const FaceVertices> faces(Geometry geometry) {
    return choose(geometry, cube_faces, tetrahedron_faces, prism_faces, pyramid_faces);
}

const char* name(Geometry geometry) {
    switch (geometry) {
    case Geometry::cube:
        return "hexahedron";
    case Geometry::tetrahedron:
        return "tetrahedron";
    case Geometry::prism:
        return "prism";
    default:
        return "pyramid";
    }
}

elvis_shape shape(Geometry geometry) {
    switch (geometry) {
    case Geometry::cube:
        return ELVIS_SHAPE_HEXAHEDRON;
    case Geometry::tetrahedron:
        return ELVIS_SHAPE_TETRAHEDRON;
    case Geometry::prism:
        return ELVIS_SHAPE_PRISM;
    default:
        return ELVIS_SHAPE_PYRAMID;
    }
}

std::span<const int> corner_vertices(Geometry geometry) {
    const std::span<const int> corners = geometry == Geometry::prism ? std::span<const int>(prism_corners) : same_corners;
    return corners.first(vertices(geometry).size());
}

Point to_mfem(Geometry geometry, const double* xi) {
    if (geometry == Geometry::prism) {
        return {0.5 * (1 + xi[0]), 0.5 * (1 + xi[2]), 0.5 * (1 - xi[1])};
    }
    return {0.5 * (1 + xi[0]), 0.5 * (1 + xi[1]), 0.5 * (1 + xi[2])};
}

Point rotate_to_elvis(Geometry geometry, const Point& vector) {
    return geometry == Geometry::prism ? Point{vector[0], -vector[2], vector[1]} : vector;
}

} // namespace elvis_mfem
