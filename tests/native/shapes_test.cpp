// Reference shapes: corners, faces, collapsed coordinates, inside.
#include "spaces.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis::native;

namespace {
constexpr Shape shapes[] = {Shape::hexahedron,  Shape::prism,         Shape::pyramid,
                            Shape::tetrahedron, Shape::quadrilateral, Shape::triangle};
}

TEST_CASE("Shapes have the corners and faces of elvis/element.h") {
    const int corners[] = {8, 6, 5, 4, 4, 3};
    const int faces[] = {6, 5, 5, 4, 4, 3};
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(n_corners(shapes[i]) == corners[i]);
        CHECK(n_faces(shapes[i]) == faces[i]);
    }
    const auto prism = face_corners(Shape::prism, 3);
    CHECK(std::vector<int>(prism.begin(), prism.end()) == std::vector<int>{3, 2, 5});
    const auto cube = face_corners(Shape::hexahedron, 2);
    CHECK(std::vector<int>(cube.begin(), cube.end()) == std::vector<int>{1, 2, 6, 5});
    // Every edge of a 3-D shape belongs to two faces, and n_corners - n_edges + n_faces = 2.
    for (const Shape shape : shapes) {
        if (dimension(shape) != 3)
            continue;
        int ends = 0;
        for (int face = 0; face < n_faces(shape); ++face)
            ends += static_cast<int>(face_corners(shape, face).size());
        CHECK(n_corners(shape) - ends / 2 + n_faces(shape) == 2);
    }
}

TEST_CASE("Corners lie on exactly the faces that list them") {
    for (const Shape shape : shapes)
        for (int i = 0; i < n_corners(shape); ++i) {
            CHECK(is_inside(shape, corner(shape, i)));
            CHECK_FALSE(is_inside(shape, corner(shape, i), -1e-9));
        }
}

TEST_CASE("Collapsing and expanding are inverse") {
    Points points(20);
    for (const Shape shape : shapes)
        for (int i = 0; i < 100; ++i) {
            const Point eta = points.eta(shape);
            const Point xi = expand(shape, eta);
            CHECK(is_inside(shape, xi, 1e-15));
            const Point back = collapse(shape, xi);
            for (std::size_t d = 0; d < 3; ++d)
                CHECK(std::abs(back[d] - eta[d]) < 1e-11);
        }
}

TEST_CASE("Collapsed coordinates at singular points are -1") {
    CHECK(collapse(Shape::tetrahedron, {-1, -1, 1}) == Point{-1, -1, 1});
    CHECK(collapse(Shape::tetrahedron, {-1, 1, -1}) == Point{-1, 1, -1});
    CHECK(collapse(Shape::prism, {-1, 0.5, 1}) == Point{-1, 0.5, 1});
    CHECK(collapse(Shape::pyramid, {-1, -1, 1}) == Point{-1, -1, 1});
    CHECK(collapse(Shape::triangle, {-1, 1, 0}) == Point{-1, 1, 0});
}

TEST_CASE("The tolerance of is_inside moves every face") {
    for (const Shape shape : shapes) {
        for (int face = 0; face < n_faces(shape); ++face) {
            // From the centre through the middle of the face, a little beyond.
            Point centre{};
            for (int i = 0; i < n_corners(shape); ++i)
                for (std::size_t d = 0; d < 3; ++d)
                    centre[d] += corner(shape, i)[d] / n_corners(shape);
            const auto corners = face_corners(shape, face);
            Point middle{};
            for (const int c : corners)
                for (std::size_t d = 0; d < 3; ++d)
                    middle[d] += corner(shape, c)[d] / static_cast<double>(corners.size());
            Point beyond{};
            for (std::size_t d = 0; d < 3; ++d)
                beyond[d] = middle[d] + 1e-3 * (middle[d] - centre[d]);
            CHECK(is_inside(shape, centre));
            CHECK_FALSE(is_inside(shape, beyond));
            CHECK_FALSE(is_inside(shape, beyond, 1e-5));
            CHECK(is_inside(shape, beyond, 1e-2));
        }
    }
    CHECK_FALSE(is_inside(Shape::hexahedron, {std::nan(""), 0, 0}, 1));
}
