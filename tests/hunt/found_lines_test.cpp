// Scenes in which the hunt found silent errors of contours and mesh lines.
#include "found_scenes.hpp"
#include "volumes.hpp"

#include <tests/support/test_volumes.hpp>

#include <core/oracle/samples/meshes.hpp>

#include <catch2/catch.hpp>

namespace elvis::hunt {

TEST_CASE("Beyond the diagonal of a triangle its field makes no contour") {
    // Two tetrahedra touch along the diagonals of their lower faces. The field of the one rises to 0 there, the other's is
    // above 3.
    const native::Space space = oracle::space_of(native::Shape::tetrahedron, 1);
    oracle::VolumeData data;
    data.classes.push_back(oracle::make_class(space, space, {[](const oracle::Vector& xi) { return xi; }},
                                              [](const oracle::Vector& x) { return x.x() + x.y(); }));
    data.classes.push_back(oracle::make_class(
        space, space, {[](const oracle::Vector& xi) -> oracle::Vector {
            return {-xi.x(), -xi.y(), xi.z()};
        }},
        [](const oracle::Vector& x) { return 3 + x.x() + x.y(); }, 1));
    std::vector<native::Face> faces;
    for (const std::int64_t element : {0, 1})
        for (std::int32_t face = 0; face < 4; ++face)
            faces.push_back({element, -1, face, -1, -1});
    const TemporaryFile file("tetrahedra.h5");
    write_volume(file.path(), data, faces);

    FrameRequest request;
    request.width = 60;
    request.height = 45;
    request.camera.eye = {0.3, -0.4, -5};
    request.camera.look_at = {0, 0, -1};
    request.camera.up = {0, 1, 0};
    request.camera.field_of_view = 40;
    Surface surface;
    surface.geometry = BoundaryFaces{};
    surface.colors.points = {{-9, {0, 0.1, 0.9}}, {9, {1, 0.8, 0.1}}};
    surface.contours = Contours{{0.02}, {1, std::array<double, 3>{0, 0, 0}, {}}};
    surface.mesh_lines.emplace();
    surface.subdivisions = 2;
    request.surfaces = {surface};
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const Tally tally = judge_picture(file.path(), request, precision);
    CHECK(tally.lines > 200);
    CHECK(tally.far + tally.near == 0);
}

TEST_CASE("A face that is seen edge on shows no line where another one far in front begins") {
    const auto block = [](const oracle::Vector& lower, const oracle::Vector& upper) -> oracle::Map {
        return [=](const oracle::Vector& xi) -> oracle::Vector {
            return lower + 0.5 * (upper - lower).cwiseProduct(oracle::Vector::Ones() + xi);
        };
    };
    const TemporaryFile file("blocks.h5");
    std::vector<native::Face> faces;
    for (const std::int64_t element : {0, 1})
        for (std::int32_t face = 0; face < 6; ++face)
            faces.push_back({element, -1, face, -1, -1});
    // Lines along the view, so that some are in the hidden part of a pixel alone.
    write_hexahedra(file.path(), {block({0, -2, -1}, {9, 2, 0}), block({0, 0.1, 0.2}, {0.2, 2, 2})}, faces,
                    [](const oracle::Vector& x) { return x.y(); });
    FrameRequest request = request_from({-3, 0, 0.7}, {7, 0.31, 0});
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 6;
    Surface surface = colored_surface();
    surface.geometry = BoundaryFaces{};
    surface.contours.emplace();
    for (int i = 0; i < 40; ++i)
        surface.contours->values.push_back(-1 + 0.0601 * i);
    request.surfaces = {surface};
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const Tally tally = judge_picture(file.path(), request, precision);
    CHECK(tally.lines > 100);
    CHECK(tally.far + tally.near == 0);
}

TEST_CASE("Seen edge on, a sphere departs farther from its tangent plane along rays than it bends across them") {
    const auto half = [](double from, double to) -> oracle::Map {
        return [=](const oracle::Vector& xi) -> oracle::Vector {
            return {xi.x(), xi.y(), from + 0.5 * (to - from) * (1 + xi.z())};
        };
    };
    const TemporaryFile file("halves.h5");
    write_hexahedra(file.path(), {half(-1, 0), half(0, 1)});
    FrameRequest request = request_from({-1, -1, -1}, {-0.3977081614781541, -0.8126679266147236, 0.404075234619105});
    request.width = 160;
    request.height = 120;
    request.camera.up = {-0.2969977321287226, 0.954878184435269, 0};
    request.camera.orthographic = true;
    request.camera.height = 3.0016114583869142;
    Surface surface = colored_surface();
    surface.geometry = Sphere{{1, -0.11567413432624947, -0.44216293283687536}, 1.6263342033134378};
    surface.mesh_lines.emplace();
    surface.subdivisions = 0;
    request.surfaces = {surface};
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const Tally tally = judge_picture(file.path(), request, precision);
    CHECK(tally.lines > 80);
    CHECK(tally.far + tally.near == 0);
}

TEST_CASE("A fold of a mesh that lies between the pixels' centres has lines, too, or its pixels are not sure") {
    const TemporaryFile file("cube.h5");
    write_hexahedra(file.path(), {[](const oracle::Vector& xi) { return xi; }});
    const auto mesh = std::make_shared<TriangleMesh>();
    // A square that faces the viewer; on it stands a triangle, of which a third of a pixel's width is seen.
    mesh->points = {{-0.9, -0.9, 0},     {0.9, -0.9, 0},     {0.9, 0.9, 0},     {-0.9, 0.9, 0},
                    {3.1 / 30, -0.8, 0}, {3.1 / 30, 0.8, 0}, {3.4 / 30, 0, 0.5}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
    FrameRequest request = request_from({0, 0, 5}, {0, 0, 0});
    request.camera.orthographic = true;
    request.camera.height = 2;
    Surface surface = colored_surface();
    surface.geometry = CutShape(MeshSurface{mesh});
    surface.contours.emplace();
    surface.contours->values = {0.05, 0.15, 0.2};
    request.surfaces = {surface};
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const Tally tally = judge_picture(file.path(), request, precision);
    CHECK(tally.lines > 100);
    CHECK(tally.far + tally.near == 0);
}

} // namespace elvis::hunt
