#include "geometry.hpp"

namespace elvis_mfem {

namespace {

using Edge = std::array<int, 2>;

constexpr Point triangle_vertices[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
constexpr Point square_vertices[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
constexpr Point cube_vertices[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
constexpr Point tetrahedron_vertices[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr Point prism_vertices[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
constexpr Point pyramid_vertices[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};

constexpr Edge triangle_edges[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr Edge square_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr Edge cube_edges[] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr Edge tetrahedron_edges[] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr Edge prism_edges[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
constexpr Edge pyramid_edges[] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};

constexpr FaceVertices cube_faces[] = {{3, 2, 1, 0}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
constexpr FaceVertices tetrahedron_faces[] = {{1, 2, 3, -1}, {0, 3, 2, -1}, {0, 1, 3, -1}, {0, 2, 1, -1}};
constexpr FaceVertices prism_faces[] = {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr FaceVertices pyramid_faces[] = {{3, 2, 1, 0}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};

constexpr int same_corners[] = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr int prism_corners[] = {3, 4, 1, 0, 5, 2};

struct Reference {
    std::span<const Point> vertices;
    std::span<const Edge> edges;
    std::span<const FaceVertices> faces;
    elvis_shape shape;
};

/** By number, from the triangle's. */
const Reference references[] = {
    {triangle_vertices, triangle_edges, {}, ELVIS_SHAPE_TRIANGLE},
    {square_vertices, square_edges, {}, ELVIS_SHAPE_QUADRILATERAL},
    {tetrahedron_vertices, tetrahedron_edges, tetrahedron_faces, ELVIS_SHAPE_TETRAHEDRON},
    {cube_vertices, cube_edges, cube_faces, ELVIS_SHAPE_HEXAHEDRON},
    {prism_vertices, prism_edges, prism_faces, ELVIS_SHAPE_PRISM},
    {pyramid_vertices, pyramid_edges, pyramid_faces, ELVIS_SHAPE_PYRAMID},
};

const Reference& reference(Geometry geometry) {
    return references[static_cast<std::size_t>(geometry) - static_cast<std::size_t>(Geometry::triangle)];
}

} // namespace

std::span<const Point> vertices(Geometry geometry) { return reference(geometry).vertices; }

std::span<const std::array<int, 2>> edges(Geometry geometry) { return reference(geometry).edges; }

std::span<const FaceVertices> faces(Geometry geometry) { return reference(geometry).faces; }

elvis_shape shape(Geometry geometry) { return reference(geometry).shape; }

std::span<const int> corner_vertices(Geometry geometry) {
    const std::span<const int> corners = geometry == Geometry::prism ? std::span<const int>(prism_corners) : same_corners;
    return corners.first(vertices(geometry).size());
}

Point to_mfem(Geometry geometry, const double* xi) {
    if (geometry == Geometry::prism) {
        return {0.5 * (1 + xi[0]), 0.5 * (1 + xi[2]), 0.5 * (1 - xi[1])};
    }
    return {0.5 * (1 + xi[0]), 0.5 * (1 + xi[1]), dimension(geometry) == 2 ? 0 : 0.5 * (1 + xi[2])};
}

Point rotate_to_elvis(Geometry geometry, const Point& vector) {
    return geometry == Geometry::prism ? Point{vector[0], -vector[2], vector[1]} : vector;
}

} // namespace elvis_mfem
