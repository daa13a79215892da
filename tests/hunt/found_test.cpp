// Scenes in which the hunt found silent errors.
#include "found_scenes.hpp"
#include "volumes.hpp"

#include <tests/support/test_volumes.hpp>

#include <core/oracle/isosurface/isosurface.hpp>
#include <core/oracle/samples/exact_volumes.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/frame_request.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

namespace elvis::hunt {

namespace {

/** An element of the unit cube between two y, the lower face of which is bent down. */
oracle::Map bulge(double from, double to, double depth = 1.2) {
    return [=](const oracle::Vector& xi) -> oracle::Vector {
        oracle::Vector x = 0.5 * (oracle::Vector::Ones() + xi);
        x.y() = from + (to - from) * x.y();
        x.z() -= 0.5 * depth * (1 - xi.x() * xi.x()) * (1 - xi.y() * xi.y()) * (1 - xi.z());
        return x;
    };
}

Tally judge_cut(const std::vector<oracle::Map>& maps, double y, Precision precision) {
    const TemporaryFile file("bulge.h5");
    write_hexahedra(file.path(), maps);
    FrameRequest request;
    request.width = 120;
    request.height = 90;
    request.camera.eye = {0.7, 1.2, 3};
    request.camera.look_at = {0.47, 0.49, 0.35};
    request.camera.up = {0.94, -0.33, 0};
    request.camera.field_of_view = 29;
    Surface surface;
    surface.geometry = CutPlane{{0, 1, 0, -y}};
    surface.colors.points = {{-3, {0, 0.1, 0.9}}, {3, {1, 0.8, 0.1}}};
    surface.mesh_lines.emplace();
    request.surfaces = {surface};
    return judge_picture(file.path(), request, precision);
}

/** Beside the middle of the lower face. */
const oracle::Vector on_bent_face{0.3, -0.2, -1};

} // namespace

TEST_CASE("A plane along faces of strongly bent elements shows their outline in each pixel") {
    // Far from where it is linearized, the mapping's error reaches over the whole element: a parallel face may lie in the
    // plane.
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const auto check = [](const Tally& tally, std::uint64_t most_open) {
        CHECK(tally.lines > 200);
        CHECK(tally.far + tally.near == 0);
        // They may fold back, as far as is known beside them. In faces a line counts that both elements are seen to end at.
        CHECK(tally.all_false_alarms <= most_open);
    };
    SECTION("between them") { check(judge_cut({bulge(0, 1)}, 0.65, precision), 21); }
    SECTION("in them") { check(judge_cut({bulge(0, 0.5), bulge(0.5, 1)}, 0.5, precision), 15); }
}

TEST_CASE("Surfaces through the eye are not seen, and are no reason for a flag") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("bulge.h5");
    const oracle::Map map = bulge(0, 1);
    write_hexahedra(file.path(), {map}, faces_of_one());
    const oracle::Vector eye = map(on_bent_face), centre = eye + 0.4 * oracle::Vector(0.36, 0.48, -0.8);
    FrameRequest request = request_from(eye, {0.5, 0.6, 0.7});
    Surface surface = colored_surface();
    const Vector3 at{centre.x(), centre.y(), centre.z()};
    SECTION("a plane") { surface.geometry = CutPlane{{0.48, 0.6, 0.64, -oracle::Vector(0.48, 0.6, 0.64).dot(eye)}}; }
    SECTION("a sphere") { surface.geometry = Sphere{at, 0.4}; }
    SECTION("a torus") { surface.geometry = Torus{at, {0.48, -0.36, 0}, 0.3, 0.1}; }
    SECTION("an implicit surface") { surface.geometry = CutShape(ImplicitSurface{"x + y * z - " + text_of(field(eye))}); }
    SECTION("faces") { surface.geometry = BoundaryFaces{}; }
    SECTION("an isosurface") { surface.geometry = Isosurfaces{.values = {field(eye)}}; }
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, precision);
    CHECK(tally.far + tally.near == 0);
    CHECK(tally.flagged < tally.pixels / 20);
}

TEST_CASE("Doubt about what is in front stays where another surface hides what is behind") {
    // The eye is on a face that is bent towards it: rays along it go on to other faces.
    const TemporaryFile file("bulge.h5");
    const oracle::Map map = bulge(0, 1, -0.7);
    write_hexahedra(file.path(), {map}, faces_of_one());
    FrameRequest request = request_from(map(on_bent_face), {0, 0.7, 0.6});
    Surface boundary = colored_surface(), plane = boundary;
    boundary.geometry = BoundaryFaces{};
    plane.geometry = CutPlane{{1, 0, 0, -0.3}};
    const RuntimeVolume volume = oracle::open_volume(file.path());
    Renderer renderer(test::device(), volume, Precision::float32);
    request.surfaces = {boundary};
    const Frame alone = renderer.render(request);
    const auto count = [&](const Frame& frame) {
        std::array<int, 2> n{};
        for (std::size_t pixel = 0; pixel < alone.flags.size(); ++pixel)
            if ((alone.flags[pixel] & pixel_flag::undecided) != 0 && !std::isnan(alone.depth[pixel]))
                ++n[(frame.flags[pixel] & pixel_flag::undecided) != 0 ? 0 : 1];
        return n;
    };
    CHECK(count(alone)[0] > 20);
    const bool is_first = GENERATE(true, false);
    request.surfaces = is_first ? std::vector{boundary, plane} : std::vector{plane, boundary};
    CHECK(count(renderer.render(request))[1] == 0);
}

TEST_CASE("A ray that enters and leaves beside an edge meets two faces, or the pixel is undecided") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("cube.h5");
    write_hexahedra(file.path(), {bulge(0, 1, 0)}, faces_of_one());
    // Pixels are some roundings of single precision wide, and some dozens.
    const double height = GENERATE(2e-5, 4e-4);
    const oracle::Vector on_edge{0, 0, 0.45}, eye = on_edge - 3 * oracle::Vector(0.8, -0.5, 0.33);
    FrameRequest request = request_from(eye, {on_edge.x(), on_edge.y(), on_edge.z()});
    request.camera.orthographic = true;
    request.camera.height = height;
    Surface surface = colored_surface();
    surface.geometry = BoundaryFaces{};
    surface.opacity = 0.5;
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, precision);
    CHECK(tally.hits > tally.pixels / 3);
    CHECK(tally.far + tally.near == 0);
    CHECK(tally.flagged < tally.pixels / 2);
}

TEST_CASE("At an edge with both faces in view the normal is that of the face, or the pixel is undecided") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("cube.h5");
    oracle::generate(R"({"generator": 1, "mesh": "box", "shape": "hexahedron", "box": [[0, 0, 0], [1, 1, 1]],)"
                     R"( "elements": [1, 1, 1], "order": 2, "geometry_order": 1, "field": "sphere"})",
                     file.path());
    const oracle::Vector on_edge{0, 0, 0.45}, eye = on_edge + 3 * oracle::Vector(-0.6, -0.7, 0.2);
    FrameRequest request = request_from(eye, {on_edge.x(), on_edge.y(), on_edge.z()});
    request.camera.orthographic = true;
    // Pixels are some roundings of single precision wide: all but a strip along the edge are decided.
    request.camera.height = 2e-5;
    Surface surface = colored_surface();
    surface.geometry = BoundaryFaces{};
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, precision);
    std::cout << "an edge in view: " << tally.far + tally.near << " silent, " << tally.flagged << " of " << tally.pixels
              << " flagged\n";
    CHECK(tally.hits == tally.pixels);
    CHECK(tally.far + tally.near == 0);
    CHECK(tally.flagged < tally.pixels / 4);
}

TEST_CASE("Isosurfaces in pyramids by projection rest on bounds, not on estimates") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("pyramids.h5");
    oracle::generate(R"({"generator": 1, "mesh": "box", "shape": "pyramid", "box": [[-1, -1, -1], [1, 1, 1]],)"
                     R"( "elements": [2, 2, 2], "order": 3, "geometry_order": 1, "field": "waves"})",
                     file.path());
    FrameRequest request = request_from({2.1, -1.7, 1.9}, {0, 0, 0});
    request.camera.field_of_view = 50;
    Surface surface = colored_surface();
    surface.geometry = Isosurfaces{.values = {-0.4, 0.1, 0.35}, .method = IsosurfaceMethod::bernstein};
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, precision);
    CHECK(tally.hits > tally.pixels / 3);
    CHECK(tally.far + tally.near == 0);
    CHECK(tally.flagged < tally.pixels / 50);
}

TEST_CASE("In pyramids that are bent so much that predictions lead to other points no crossing is missed") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("torus.h5");
    oracle::generate(R"({"generator": 1, "mesh": "torus", "shape": "pyramid", "elements": [3, 1, 4], "layers": 2,)"
                     R"( "order": 5, "geometry_order": 4, "field": "sphere"})",
                     file.path());
    FrameRequest request = request_from({-0.23601224082715197, 2.292304893646951, 2.0293439090526646},
                                        {-0.5080298233071213, -0.9250201885106666, 0.025640899487317625});
    request.camera.up = {0.9857259144840135, 0.16835801589070715, 0};
    request.camera.field_of_view = 4;
    request.width = 16;
    request.height = 12;
    Surface surface = colored_surface();
    surface.geometry = Isosurfaces{.values = {1.1236413698447634}};
    surface.clip = {{-0.4279854530031429, 0.6044645922963239, 0.671901040836918, 0.43523404403054633}};
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, precision);
    std::cout << "bent pyramids: " << tally.hits << " hits, " << tally.far + tally.near << " silent, " << tally.flagged
              << " of " << tally.pixels << " flagged\n";
    CHECK(tally.hits > tally.pixels / 20);
    CHECK(tally.far + tally.near == 0);
}

TEST_CASE("By eigenvalues, a crossing of the last round that is found again hides no other") {
    // Far from the origin, rounding lets single precision find the last crossing again.
    const TemporaryFile file("far.h5");
    const oracle::Vector middle{1e4, -1e4, 1e4};
    oracle::VolumeData data;
    data.classes.push_back(oracle::make_class(
        oracle::space_of(native::Shape::hexahedron, 1), oracle::space_of(native::Shape::hexahedron, 9),
        {[=](const oracle::Vector& xi) -> oracle::Vector { return middle + xi; }}, [=](const oracle::Vector& x) {
            const oracle::Vector d = x - middle;
            return std::sin(4 * d.x()) * std::cos(3 * d.y()) + 0.5 * std::sin(5 * d.z() + d.x());
        }));
    write_volume(file.path(), data);
    FrameRequest request = request_from(middle + oracle::Vector(2.6, -2, 1.9), {middle.x(), middle.y(), middle.z()});
    request.camera.field_of_view = 50;
    Surface surface = colored_surface();
    surface.geometry = Isosurfaces{.values = {-0.2, 0.1}, .method = IsosurfaceMethod::companion};
    surface.opacity = 0.5;
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, Precision::float32);
    std::cout << "companion: " << tally.hits << " hits, " << tally.far + tally.near << " silent, " << tally.flagged
              << " flagged\n";
    CHECK(tally.hits > tally.pixels / 4);
    CHECK(tally.far + tally.near == 0);
    CHECK(tally.flagged < tally.pixels / 10);
}

} // namespace elvis::hunt
