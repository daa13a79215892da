// Meshes of surfaces against closed forms, in bent elements of every shape.
#include <core/base/error.hpp>
#include <core/extract/extraction.hpp>
#include <tests/integrate/integrated.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>
#include <numbers>

namespace elvis::test {
namespace {

using Surface = ExtractionRequest::Surface;
constexpr double pi = std::numbers::pi;

SurfaceMesh extracted(const GeneratedVolume& volume, const ExtractionRequest& request) {
    const TaskControl control;
    return extract(*volume, request, control);
}

ExtractionRequest isosurface(const std::string& field, double isovalue, double tolerance) {
    ExtractionRequest request;
    request.level_field = field;
    request.isovalue = isovalue;
    request.tolerance = tolerance;
    return request;
}

ExtractionRequest plane(const std::array<double, 4>& numbers, double tolerance) {
    ExtractionRequest request;
    request.surface = Surface::plane;
    request.plane = numbers;
    request.tolerance = tolerance;
    return request;
}

ExtractionRequest boundary(double tolerance) {
    ExtractionRequest request;
    request.surface = Surface::boundary;
    request.tolerance = tolerance;
    return request;
}

void check_closed(const SurfaceMesh& mesh, std::int64_t euler_number) {
    CHECK(mesh.n_rim_edges == 0);
    CHECK(mesh.n_inner_edges == 0);
    CHECK(mesh.n_branching_edges == 0);
    CHECK(mesh.euler_number == euler_number);
    CHECK(mesh.mesh_to_surface <= mesh.tolerance);
    CHECK(mesh.surface_to_mesh <= mesh.tolerance);
}

std::string bent(const std::string& shape) {
    return shape_key(shape) + R"("mesh": "waves", "elements": [4, 2, 2], "geometry_order": 3, "amplitude": 0.08,
        "fields": [{"field": "sphere", "order": 6}])";
}

/** Of all triangles the largest distance of points from a sphere, and how vertices and normals are off. */
struct SphereErrors {
    double mesh = 0, vertices = 0, normals = 0;

    SphereErrors(const SurfaceMesh& found, double radius) {
        for (std::size_t i = 0; i < found.positions.size(); ++i) {
            vertices = std::max(vertices, std::abs(length(found.positions[i]) - radius));
            normals = std::max(normals, length(minus(found.normals[i], unit(found.positions[i]))));
        }
        for (const auto& [a, b, c] : found.triangles) {
            constexpr int n = 6;
            for (int i = 0; i <= n; ++i) {
                for (int j = 0; i + j <= n; ++j) {
                    const Vector3 point = scaled(plus(plus(scaled(found.positions[a], i), scaled(found.positions[b], j)),
                                                      scaled(found.positions[c], n - i - j)),
                                                 1.0 / n);
                    mesh = std::max(mesh, std::abs(length(point) - radius));
                }
            }
        }
    }
};

TEST_CASE("a sphere in bent elements is closed, and as near as was asked for") {
    const std::string shape = GENERATE("hexahedron", "prism", "pyramid", "tetrahedron", "mixed");
    const GeneratedVolume volume(bent(shape));
    const SurfaceMesh mesh = extracted(volume, isosurface("sphere", 0.36, 1e-3));
    const SphereErrors errors(mesh, 0.6);
    std::cout << shape << ": " << mesh.triangles.size() << " triangles, off by " << errors.mesh << " of " << mesh.tolerance
              << ", said " << mesh.mesh_to_surface << "; vertices by " << errors.vertices << ", normals by " << errors.normals
              << "; area short of " << 1 - mesh.measure / (4 * pi * 0.36) << ", volume of "
              << 1 - mesh.volume / (4 * pi / 3 * 0.216) << "\n";
    check_closed(mesh, 2);
    CHECK(errors.mesh <= mesh.tolerance);
    CHECK(errors.mesh <= 1.5 * mesh.mesh_to_surface);
    CHECK(errors.vertices < 1e-12);
    CHECK(errors.normals < 1e-9);
    // A chord that is off by d takes off less than d over the radius of the area, and three times that of the volume.
    CHECK(std::abs(mesh.measure / (4 * pi * 0.36) - 1) < mesh.tolerance / 0.6);
    CHECK(std::abs(mesh.volume / (4 * pi / 3 * 0.216) - 1) < 3 * mesh.tolerance / 0.6);
    CHECK(mesh.n_undecided == 0);
    CHECK(mesh.triangles.size() < 8000);
    if (shape == "hexahedron") {
        CHECK(mesh.is_certified);
    }
}

TEST_CASE("triangles are seen anticlockwise from where the field is larger, in elements that are inside out, too") {
    const GeneratedVolume volume(R"("mesh": "box", "elements": 3, "field": "sphere")");
    const SurfaceMesh mesh = extracted(volume, isosurface("sphere", 0.36, 3e-3));
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vector3 area = cross(minus(mesh.positions[b], mesh.positions[a]), minus(mesh.positions[c], mesh.positions[a]));
        REQUIRE(dot(area, mesh.positions[a]) >= 0);
    }
}

TEST_CASE("a finer tolerance is kept, with as many triangles more as it takes") {
    const GeneratedVolume volume(bent("mixed"));
    const SurfaceMesh coarse = extracted(volume, isosurface("sphere", 0.36, 4e-3));
    const SurfaceMesh fine = extracted(volume, isosurface("sphere", 0.36, 4e-4));
    std::cout << coarse.triangles.size() << " and " << fine.triangles.size() << " triangles, off by "
              << SphereErrors(coarse, 0.6).mesh << " and " << SphereErrors(fine, 0.6).mesh << "\n";
    CHECK(SphereErrors(fine, 0.6).mesh <= fine.tolerance);
    // Ten times as near takes ten times the triangles.
    CHECK(fine.triangles.size() < 20 * coarse.triangles.size());
    check_closed(fine, 2);
}

TEST_CASE("a torus has one hole") {
    const GeneratedVolume volume(shape_key("mixed") + R"("mesh": "box", "elements": 4, "field": "sphere")");
    const SurfaceMesh mesh = extracted(volume, isosurface("(sqrt(x^2 + y^2) - 0.6)^2 + z^2", 0.0625, 2e-3));
    const double area = 4 * pi * pi * 0.6 * 0.25, inside = 2 * pi * pi * 0.6 * 0.0625;
    std::cout << "torus: area short of " << 1 - mesh.measure / area << ", volume of " << 1 - mesh.volume / inside << "\n";
    check_closed(mesh, 0);
    CHECK_FALSE(mesh.is_certified);
    CHECK(std::abs(mesh.measure / area - 1) < mesh.tolerance / 0.25);
    CHECK(std::abs(mesh.volume / inside - 1) < 2 * mesh.tolerance / 0.25);
}

TEST_CASE("a part of the surface that is small against elements is not missed") {
    const GeneratedVolume volume(shape_key("hexahedron") +
                                 R"("mesh": "box", "elements": 2, "field": "polynomial", "order": 4)");
    // A hundredth of an element's volume, far from its corners; and half of such a part, which ends in an outer face.
    const std::string ball = "(x - 0.53)^2 + (y - 0.41)^2 + (z - 0.37)^2";
    const SurfaceMesh whole = extracted(volume, isosurface(ball, 0.0004, 1e-3));
    CHECK(whole.is_certified);
    check_closed(whole, 2);
    CHECK(std::abs(whole.measure / (4 * pi * 0.0004) - 1) < 0.1);
    const SurfaceMesh half = extracted(volume, isosurface("(x - 1)^2 + (y - 0.41)^2 + (z - 0.37)^2", 0.0004, 1e-3));
    CHECK(half.is_certified);
    CHECK(half.euler_number == 1);
    CHECK(half.n_rim_edges > 0);
    CHECK(half.n_inner_edges == 0);
    CHECK(std::abs(half.measure / (2 * pi * 0.0004) - 1) < 0.15);
}

TEST_CASE("a plane's mesh ends in the outer boundary, and its rim follows it") {
    const GeneratedVolume ball(R"("mesh": "ball", "elements": 3, "geometry_order": 4, "field": "sphere")");
    const SurfaceMesh mesh = extracted(ball, plane({0.6, 0, 0.8, -0.1}, 1e-3));
    const double area = pi * 0.99;
    std::cout << "disc: area short of " << 1 - mesh.measure / area << ", rim off by " << mesh.surface_to_mesh << "\n";
    CHECK(std::abs(mesh.measure / area - 1) < 2 * mesh.tolerance);
    CHECK(mesh.euler_number == 1);
    CHECK(mesh.n_inner_edges == 0);
    CHECK(mesh.n_rim_edges > 20);
    CHECK(mesh.surface_to_mesh <= mesh.tolerance);
    double off = 0;
    for (const Vector3& position : mesh.positions) {
        off = std::max(off, std::abs(dot(position, {0.6, 0, 0.8}) - 0.1));
    }
    CHECK(off < 1e-14);
}

TEST_CASE("a plane in faces between elements counts once") {
    const std::string shape = GENERATE("hexahedron", "prism", "tetrahedron");
    const GeneratedVolume box(shape_key(shape) + R"("mesh": "box", "elements": 4, "field": "sphere")");
    const SurfaceMesh mesh = extracted(box, plane({1, 0, 0, 0}, 1e-2));
    CHECK(std::abs(mesh.measure - 4) < 1e-12);
    CHECK(mesh.n_inner_edges == 0);
    CHECK(mesh.euler_number == 1);
}

TEST_CASE("the boundary is closed, and its area and volume are those of the mesh") {
    const GeneratedVolume ball(R"("mesh": "ball", "elements": 3, "geometry_order": 4, "field": "sphere")");
    const SurfaceMesh mesh = extracted(ball, boundary(1e-3));
    IntegralRequest area = over(IntegralRequest::Domain::boundary, "");
    area.tolerance = 1e-6;
    const double exact = integral_of(ball, area).measure;
    check_closed(mesh, 2);
    CHECK(std::abs(mesh.measure / exact - 1) < mesh.tolerance);
    CHECK(std::abs(mesh.volume / (4 * pi / 3) - 1) < 3 * mesh.tolerance);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        REQUIRE(dot(mesh.normals[i], unit(mesh.positions[i])) > 0.99);
    }
    const GeneratedVolume box(shape_key("mixed") + R"("mesh": "box", "elements": 2, "field": "sphere")");
    ExtractionRequest side = boundary(1e-3);
    side.groups = {"z+"};
    const SurfaceMesh lid = extracted(box, side);
    CHECK(std::abs(lid.measure - 4) < 1e-13);
    CHECK(lid.normals.front() == Vector3{0, 0, 1});
    CHECK(lid.n_rim_edges > 0);
}

TEST_CASE("contours are lines on the true surface") {
    const GeneratedVolume ball(R"("mesh": "ball", "elements": 3, "geometry_order": 4, "field": "sphere")");
    ExtractionRequest on_plane = plane({0, 0, 1, 0.1}, 1e-3);
    on_plane.contour_field = "x^2 + y^2";
    on_plane.contours = {0.25, 0.04};
    const SurfaceMesh circles = extracted(ball, on_plane);
    REQUIRE(circles.line_values.size() == 2);
    CHECK(circles.n_open_ends == 0);
    CHECK(circles.triangles.empty());
    double off = 0;
    for (std::size_t line = 0; line < 2; ++line) {
        const std::size_t first = circles.line_first[line], last = circles.line_first[line + 1] - 1;
        CHECK(circles.line_vertices[first] == circles.line_vertices[last]);
        for (std::size_t at = first; at <= last; ++at) {
            const Vector3& position = circles.positions[circles.line_vertices[at]];
            off = std::max({off, std::abs(position[2] + 0.1),
                            std::abs(std::hypot(position[0], position[1]) - std::sqrt(circles.line_values[line]))});
        }
    }
    std::cout << "circles: points off by " << off << ", length short of " << 1 - circles.measure / (2 * pi * 0.7) << "\n";
    CHECK(off < 1e-12);
    CHECK(std::abs(circles.measure / (2 * pi * 0.7) - 1) < circles.tolerance / 0.2);
    CHECK(circles.surface_to_mesh <= circles.tolerance);

    ExtractionRequest on_boundary = boundary(1e-3);
    on_boundary.contour_field = "z";
    on_boundary.contours = {0.6};
    const SurfaceMesh latitude = extracted(ball, on_boundary);
    REQUIRE(latitude.line_values.size() == 1);
    CHECK(std::abs(latitude.measure / (2 * pi * 0.8) - 1) < latitude.tolerance);
}

TEST_CASE("where a field jumps, the mesh ends and says so") {
    const GeneratedVolume box(R"("mesh": "box", "elements": [2, 1, 1], "field": "sphere")");
    const SurfaceMesh mesh = extracted(box, isosurface("x^2 + y^2 + z^2 + 0.1*element", 0.36, 3e-3));
    CHECK(mesh.n_inner_edges > 10);
    CHECK(mesh.n_rim_edges == 0);
    const double area = 2 * pi * 0.36 + 2 * pi * 0.26;
    CHECK(std::abs(mesh.measure / area - 1) < 0.02);
}

TEST_CASE("elements of two dimensions are extracted themselves, and lines on them") {
    const GeneratedVolume flat(shape_key("quadrilateral") + R"("mesh": "box", "elements": [3, 2], "field": "sphere")");
    const SurfaceMesh all = extracted(flat, boundary(1e-3));
    CHECK(std::abs(all.measure - 4) < 1e-13);
    CHECK(all.euler_number == 1);
    CHECK(all.n_inner_edges == 0);
    const SurfaceMesh circle = extracted(flat, isosurface("x^2 + y^2", 0.25, 1e-3));
    REQUIRE(circle.line_values.size() == 1);
    CHECK(std::abs(circle.measure / pi - 1) < circle.tolerance / 0.5);
    CHECK(circle.n_open_ends == 0);
}

TEST_CASE("what cannot be extracted is refused with its cause") {
    const GeneratedVolume box(R"("mesh": "box", "elements": 2, "field": "sphere")");
    CHECK_THROWS_WITH(extracted(box, isosurface("sphere2", 0.3, 1e-3)), Catch::Contains("sphere2"));
    ExtractionRequest late = isosurface("sphere", 0.3, 1e-3);
    late.time_step = 3;
    CHECK_THROWS_WITH(extracted(box, late), Catch::Contains("no time step 3"));
    ExtractionRequest many = isosurface("sphere", 0.3, 1e-5);
    many.most_cells = 1000;
    CHECK_THROWS_WITH(extracted(box, many), Catch::Contains("larger tolerance"));
    ExtractionRequest nowhere = boundary(1e-3);
    nowhere.groups = {"lid"};
    CHECK_THROWS_WITH(extracted(box, nowhere), Catch::Contains("lid"));
    CHECK(extracted(box, isosurface("sphere", 30, 1e-3)).triangles.empty());
}

} // namespace
} // namespace elvis::test
