// Curved edges and faces: every point set, however edges run and faces are turned, plain and compressed.
#include "fixture.hpp"
#include "nektar_writer.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using nektar_writer::Point;
using nektar_writer::Shape;

namespace {

/** Of degree 3, so that four points along an edge hold it on edges and faces. */
Point bent(const Point& xi) {
    const auto [a, b, c] = xi;
    return {a + 0.1 * b * b * c - 0.07 * a * b, b + 0.05 * a * a * a + 0.08 * b * c, c - 0.06 * a * b * c + 0.09 * a * a * b};
}

/** Same in a plane. */
Point bent_flat(const Point& xi) {
    const auto [a, b, c] = xi;
    return {a + 0.1 * b * b * b - 0.07 * a * b, b + 0.05 * a * a * b + 0.04 * a * a, 0};
}

Point weighted(const std::vector<Point>& corners, const std::vector<double>& weights) {
    Point x{};
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            x[axis] += weights[corner] * corners[corner][axis];
        }
    }
    return x;
}

/** Points inside of a local face, or of an element of two dimensions. */
std::vector<Point> points_on(Shape shape, int face) {
    std::vector<Point> corners;
    if (native::dimension(shape) == 2) {
        for (int corner = 0; corner < native::n_corners(shape); ++corner) {
            corners.push_back(native::corner(shape, corner));
        }
    } else {
        for (const int corner : native::face_corners(shape, face)) {
            corners.push_back(native::corner(shape, corner));
        }
    }
    std::vector<Point> points;
    for (const double s : {0.05, 0.3, 0.45}) {
        for (const double t : {0.1, 0.25, 0.5}) {
            points.push_back(corners.size() == 3 ? weighted(corners, {1 - s - t, s, t})
                                                 : weighted(corners, {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}));
        }
    }
    return points;
}

double largest_error(const SourceVolume& source, Shape shape, Point (*map)(const Point&)) {
    double largest = 0;
    const int n_faces = native::dimension(shape) == 2 ? 1 : native::n_faces(shape);
    for (int face = 0; face < n_faces; ++face) {
        for (const Point& xi : points_on(shape, face)) {
            const Point x = position_at(source, 0, xi), wanted = map(xi);
            largest = std::max(largest, std::hypot(x[0] - wanted[0], x[1] - wanted[1], x[2] - wanted[2]));
        }
    }
    return largest;
}

} // namespace

TEST_CASE("curved faces lie where their points are, however they are turned", "[nektarpp]") {
    const Shape shape = GENERATE(Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron);
    const int turn = GENERATE(range(0, 8));
    const bool is_compressed = GENERATE(false, true);
    const auto [edge_points, triangle_points] =
        GENERATE(table<std::string, std::string>({{"PolyEvenlySpaced", "NodalTriEvenlySpaced"},
                                                  {"GaussLobattoLegendre", "NodalTriElec"},
                                                  {"GaussLobattoLegendre", "NodalTriFekete"}}));
    const nektar_writer::Element element{shape, bent, 4, edge_points, triangle_points, turn, is_compressed, {}};
    const TemporaryFolder folder;
    const SourceVolume source = open_nektar({folder.write("bent.xml", nektar_writer::geometry_file(element))});
    CAPTURE(native::name(shape), turn, is_compressed, edge_points, triangle_points);
    // Electrostatic and Fekete points are tabulated to ten digits.
    const double tolerance = triangle_points == "NodalTriEvenlySpaced" ? 1e-14 : 1e-9;
    CHECK(largest_error(source, shape, bent) <= tolerance);
    std::vector<elvis_source_element> elements(1);
    source.elements(0, 1, elements);
    CHECK(elements[0].geometry_order[0] == 3);
    CHECK(elements[0].geometry_order[2] == (shape == Shape::pyramid ? 4 : 3));
    CHECK(source.boundary_groups() == std::vector<std::string>{"hull"});
    CHECK(elements[0].face_groups[0] == 0);
    CHECK(elements[0].face_groups[1] == ELVIS_GROUP_NONE);
}

TEST_CASE("elements of two dimensions are curved inside", "[nektarpp]") {
    const Shape shape = GENERATE(Shape::quadrilateral, Shape::triangle);
    const int turn = GENERATE(0, 1);
    const bool is_compressed = GENERATE(false, true);
    const nektar_writer::Element element{shape, bent_flat,     4, "PolyEvenlySpaced", "NodalTriEvenlySpaced",
                                         turn,  is_compressed, {}};
    const TemporaryFolder folder;
    const SourceVolume source = open_nektar({folder.write("flat.xml", nektar_writer::geometry_file(element))});
    CHECK(source.info().dimension == 2);
    CHECK(largest_error(source, shape, bent_flat) <= 1e-14);
    CHECK(source.boundary_groups() == std::vector<std::string>{"hull"});
}

TEST_CASE("a mesh is scaled and moved by expressions, curves included", "[nektarpp]") {
    const std::string attributes = R"x(XSCALE="2*PI" YSCALE="-(1 + sqrt(4))^2/3" ZMOVE="1e1 - exp(0)*abs(-.5)" XMOVE="-2^2")x";
    const bool is_compressed = GENERATE(false, true);
    const nektar_writer::Element element{Shape::hexahedron, bent,      4, "PolyEvenlySpaced", "NodalTriEvenlySpaced", 3,
                                         is_compressed,     attributes};
    const TemporaryFolder folder;
    const SourceVolume source = open_nektar({folder.write("scaled.xml", nektar_writer::geometry_file(element))});
    const auto moved = [](const Point& xi) -> Point {
        const Point x = bent(xi);
        return {2 * std::acos(-1.0) * x[0] - 4, -3 * x[1], x[2] + 9.5};
    };
    CHECK(largest_error(source, Shape::hexahedron, moved) <= 1e-13);
}
