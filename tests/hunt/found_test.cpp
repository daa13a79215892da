// Scenes in which the hunt found silent errors.
#include "judge.hpp"
#include "scenes.hpp"
#include "volumes.hpp"

#include <tests/support/test_volumes.hpp>

#include <core/oracle/isosurface/isosurface.hpp>
#include <core/oracle/samples/exact_volumes.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/frame_request.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace elvis::hunt {

namespace {

Tally judge_picture(const std::string& path, const FrameRequest& request, Precision precision) {
    const RuntimeVolume volume = oracle::open_volume(path);
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    oracle::SceneVolume answers(path, faces);
    std::string reason;
    Judge judge(answers, request, reason);
    judge.draw();
    Renderer renderer(test::device(), volume, precision);
    const Judgement j = judge.judge(renderer.render(request), precision);
    if (!j.findings.empty())
        std::cout << j.findings[0].row << " " << j.findings[0].column << " wrong " << j.findings[0].wrong << "\n"
                  << j.findings[0].shown << "\n"
                  << j.findings[0].truth << "\n";
    return j.tally;
}

/** An element of the unit cube between two y, the lower face of which is bent down. */
oracle::Map bulge(double from, double to, double depth = 1.2) {
    return [=](const oracle::Vector& xi) -> oracle::Vector {
        oracle::Vector x = 0.5 * (oracle::Vector::Ones() + xi);
        x.y() = from + (to - from) * x.y();
        x.z() -= 0.5 * depth * (1 - xi.x() * xi.x()) * (1 - xi.y() * xi.y()) * (1 - xi.z());
        return x;
    };
}

std::string text_of(double number) {
    std::ostringstream text;
    text << std::setprecision(17) << number;
    return text.str();
}

double field(const oracle::Vector& x) { return x.x() + x.y() * x.z(); }

void write_hexahedra(const std::string& path, const std::vector<oracle::Map>& maps, const std::vector<native::Face>& faces = {},
                     const oracle::Function& values = field) {
    const native::Space space = oracle::space_of(native::Shape::hexahedron, 2);
    oracle::VolumeData data;
    data.classes.push_back(oracle::make_class(space, space, maps, values));
    write_volume(path, data, faces);
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

std::vector<native::Face> faces_of_one() {
    std::vector<native::Face> faces;
    for (std::int32_t face = 0; face < 6; ++face)
        faces.push_back({0, -1, face, -1, -1});
    return faces;
}

/** Beside the middle of the lower face. */
const oracle::Vector on_bent_face{0.3, -0.2, -1};

FrameRequest request_from(const oracle::Vector& eye, const Vector3& look_at) {
    FrameRequest request;
    request.width = 80;
    request.height = 60;
    request.camera.eye = {eye.x(), eye.y(), eye.z()};
    request.camera.look_at = look_at;
    request.camera.up = {0, 1, 0};
    request.camera.field_of_view = 100;
    request.camera.near = 2e-4;
    return request;
}

Surface colored_surface() {
    Surface surface;
    surface.colors.points = {{-3, {0, 0.1, 0.9}}, {3, {1, 0.8, 0.1}}};
    return surface;
}

} // namespace

TEST_CASE("A plane along faces of strongly bent elements shows their outline in each pixel") {
    // Far from where it is linearized, the mapping's error reaches over the whole element: a parallel face may lie in the
    // plane.
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const auto check = [](const Tally& tally) {
        CHECK(tally.lines > 200);
        CHECK(tally.far + tally.near == 0);
        CHECK(tally.all_false_alarms == 0);
    };
    SECTION("between them") { check(judge_cut({bulge(0, 1)}, 0.65, precision)); }
    SECTION("in them") { check(judge_cut({bulge(0, 0.5), bulge(0.5, 1)}, 0.5, precision)); }
}

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

namespace {

/** A picture of the hunt's volume 266: one bent hexahedron, with a field of order 7 that is not resolved. */
FrameRequest request_of_rough_field(const Vector3& eye, const Vector3& look_at, const Vector3& up, double field_of_view) {
    FrameRequest request;
    request.width = 48;
    request.height = 36;
    request.camera.eye = eye;
    request.camera.look_at = look_at;
    request.camera.up = up;
    request.camera.field_of_view = field_of_view;
    request.background = {0.125, 0.25, 0.375, 1};
    return request;
}

Tally judge_rough_field(const FrameRequest& request, Precision precision) {
    const TemporaryFile file("rough.h5");
    const PluginRegistry plugins;
    make_volume(plugins, 266, {}, file.path());
    return judge_picture(file.path(), request, precision);
}

} // namespace

TEST_CASE("Isosurfaces of rough fields of high order are not undecided all over") {
    FrameRequest request = request_of_rough_field({0.186, 1.667, -1.337}, {-0.157, -0.141, 0.019}, {0.983, -0.186, 0}, 58.7);
    Surface surface = colored_surface();
    surface.geometry = Isosurfaces{.values = {-0.336}};
    request.surfaces = {surface};
    const Tally tally = judge_rough_field(request, Precision::float32);
    CHECK(tally.hits > tally.pixels / 3);
    CHECK(tally.far + tally.near == 0);
    // Was half of them.
    CHECK(tally.flagged < tally.pixels / 100);
}

TEST_CASE("A narrow peak between the samples of a step is found") {
    FrameRequest request = request_of_rough_field({-1.275316879459872, 0.11743809500417267, -3.139820822399736},
                                                  {-0.12538921728558483, 0.0036675741902809297, 0.14033107231184935},
                                                  {0.09845641167477687, 0.9951413643297754, 0}, 10);
    request.volume.emplace().transfer = {{{2.6073025, 0}, {2.61811978, 163.3}, {2.62893706, 0}}, {{2.6, {0.5, 0.7, 0.4}}}};
    const Tally tally = judge_rough_field(request, Precision::float64);
    CHECK(tally.far + tally.near == 0);
    CHECK(tally.flagged == 0);
}

TEST_CASE("Colours that jump do not flag rough fields all over") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    FrameRequest request = request_of_rough_field({1.914, -4.491, -0.042}, {-0.030, -0.138, 0.014}, {-0.913, -0.408, 0}, 28);
    request.volume.emplace().transfer = {
        {{-1.069, 0.0196}, {0.1906, 0.0456}, {1.0244, 0.0967}, {3.2287, 0.0528}, {4.0087, 0.0039}},
        {{-2.2407, {0.3, 0.9, 0.9}}, {-2.2407, {0, 0.6, 0.9}}, {1.0244, {0.3, 0.15, 0.8}}, {1.917, {0.9, 0.8, 0.4}}}};
    const Tally tally = judge_rough_field(request, precision);
    CHECK(tally.far + tally.near == 0);
    // Was a third of them.
    CHECK(tally.flagged < tally.pixels / 100);
}

TEST_CASE("Where light changes at a jump alone, samples are good enough to place it") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    FrameRequest request = request_of_rough_field({1.914, -4.491, -0.042}, {-0.030, -0.138, 0.014}, {-0.913, -0.408, 0}, 28);
    request.volume.emplace().transfer = {{{0, 0.3}}, {{1.0244, {0.3, 0.9, 0.9}}, {1.0244, {0, 0.6, 0.9}}}};
    const Tally tally = judge_rough_field(request, precision);
    std::cout << "one jump: " << tally.flagged << " of " << tally.pixels << " flagged\n";
    CHECK(tally.far + tally.near == 0);
    CHECK(tally.flagged < tally.pixels / 50);
}

TEST_CASE("The adaptive rule misses no narrow peak in a field of high order") {
    const TemporaryFile file("rough.h5");
    const PluginRegistry plugins;
    make_volume(plugins, 266, {}, file.path());
    const RuntimeVolume volume = oracle::open_volume(file.path());
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    oracle::SceneVolume answers(file.path(), faces);
    const SceneGround ground =
        ground_of(file.path(), volume.fields()[0].name, answers.model(0, 0).volume, volume.n_faces() > 0);
    Scene scene = make_scene(ground, "volume", 16005);
    scene.size = {60, 45};
    REQUIRE(scene.volume_rendering->integrator == Integrator::adaptive_trapezoid);
    Renderer renderer(test::device(), volume, Precision::float64);
    const FrameRequest request = make_frame_request(scene, volume, renderer.ranges());
    const Tally tally = judge_picture(file.path(), request, Precision::float64);
    CHECK(tally.pixels == 60 * 45);
    // Was 1 in 100 with three samples an element.
    CHECK(tally.far + tally.near == 0);
}

TEST_CASE("Where the oracle says that a ray meets a face, it does") {
    // It nearly touches the face of a bent tetrahedron: Newton's steps come to no end there, and are no crossing.
    const TemporaryFile file("grazed.h5");
    oracle::generate(R"({"generator": 1, "mesh": "waves", "shape": "tetrahedron", "elements": [3, 2, 3], "geometry_order": 4,
                       "order": 5, "field": "polynomial"})",
                     file.path());
    oracle::SceneVolume volume(file.path(), {});
    const oracle::Model& model = volume.model(0, 0);
    const oracle::SegmentFinder finder(model);
    oracle::Inverter inverter(model.volume, model.enclosures);
    Camera camera;
    camera.eye = {-1.6649923697999451, 0.6882894652222804, -0.9160261876206469};
    camera.look_at = {0.08660089320246946, -0.1752880072009896, -0.06854768145518876};
    camera.up = {0.44220106553518296, 0.8969159479235213, 0.0};
    camera.field_of_view = 44.083790000905;
    const oracle::Line line = oracle::line_of(oracle::pixel_ray(camera, 800, 600, 56, 299));
    std::size_t n_crossings = 0;
    for (std::size_t element = 0; element < model.volume.n_elements(); ++element)
        for (std::size_t constraint = 0; constraint < 4; ++constraint)
            for (const double t : finder.crossings(element, constraint, line)) {
                const std::vector<oracle::Solution> found = inverter.find(element, line.at(t), 1e-9);
                CAPTURE(element, constraint, t);
                REQUIRE(found.size() == 1);
                CHECK(std::abs(found[0].excess) < 1e-9);
                ++n_crossings;
            }
    CHECK(n_crossings > 10);
}

TEST_CASE("Near the apex of a cone, rounding that turns the normal is flagged") {
    const TemporaryFile file("cube.h5");
    const oracle::Map cube = [](const oracle::Vector& xi) -> oracle::Vector { return xi; };
    write_hexahedra(file.path(), {cube}, faces_of_one());
    FrameRequest request = request_from({1.7, 1.1, 4.1}, {0.11, 0.23, 0.31});
    request.camera.field_of_view = 0.08;
    request.lighting.emplace();
    Surface surface = colored_surface();
    surface.geometry = CutShape{Cone{{0.11, 0.23, 0.31}, {0.4, -0.9, -0.7}, 0, 0.6, true}};
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, Precision::float32);
    std::cout << "apex: " << tally.far + tally.near << " silent, " << tally.flagged << " of " << tally.pixels << " flagged\n";
    CHECK(tally.flagged > 100);
    CHECK(tally.far + tally.near == 0);
}

TEST_CASE("In bent pyramids a value is that of the pixel's point") {
    // Newton's method ended a step too early: where no bound of the mapping's curvature is known it had been taken to be 1.
    const TemporaryFile file("shell.h5");
    oracle::generate(
        R"({"generator": 1, "mesh": "shell", "shape": "pyramid", "elements": [2, 2, 1], "layers": 2, "geometry_order": 2,
                         "order": 4, "field": "waves"})",
        file.path());
    FrameRequest request;
    request.width = 800;
    request.height = part_rows;
    request.part = {48, 600};
    request.camera.orthographic = true;
    request.camera.eye = {1.3683034274963923, 0.6662418633934617, -1.20847840940015};
    request.camera.look_at = {-0.1307684921623505, 0.07410543585245408, 0.11684720633802809};
    request.camera.up = {0.3673799055091592, -0.9300709677374525, 0.0};
    request.camera.height = 1.674399855648155;
    Surface surface = colored_surface();
    surface.geometry = CutShape{ImplicitSurface{
        .expression = "0.5898072607402618 * (z - 0.67859834454584711) + 0.4033737376676072 * 0.5898072607402618 * (x + "
                      "0.67859834454584644) + 0.21897386597872365 * sin(5.0894968319180443 * 0.5898072607402618 * (x + "
                      "0.67859834454584644)) * cos(5.0894968319180443 * 0.5898072607402618 * (y + 0.28108463771482006))"}};
    request.surfaces = {surface};
    const RuntimeVolume volume = oracle::open_volume(file.path());
    const Frame frame = Renderer(test::device(), volume, Precision::float32).render(request);
    const std::size_t pixel = (58 - 48) * 800 + 387;
    REQUIRE(frame.element[pixel] == 53);
    // By the oracle; its slope is 4.4, and the point is off by 1e-6.
    CHECK(frame.value[pixel] == Approx(0.752930248862439).margin(2e-5));
    CHECK(frame.flags[pixel] == 0);
}

TEST_CASE("Where a surface's point is vague, so is whether it is clipped") {
    // x y - 1e8 has errors of 6 in single precision, and a slope of 14142: points are off by 4e-4 along the ray.
    const TemporaryFile file("far.h5");
    const oracle::Map cube = [](const oracle::Vector& xi) -> oracle::Vector {
        return 0.5 * xi + oracle::Vector(10000, 10000, 0);
    };
    write_hexahedra(file.path(), {cube}, faces_of_one(), [](const oracle::Vector& x) { return x.z(); });
    FrameRequest request = request_from({9998.4, 9998.6, 0.3}, {10000, 10000, 0});
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 40;
    Surface surface = colored_surface();
    surface.geometry = CutShape{ImplicitSurface{.expression = "x * y - 100000000"}};
    // The surface lies in the plane x + y = 20000, but for what it is bent: 2.5e-5 at most.
    const double side = GENERATE(1.0, -1.0);
    surface.clip = {{side, side, 0, side * (-20000 - 1e-4)}};
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, Precision::float32);
    std::cout << "vague points: " << tally.far + tally.near << " silent, " << tally.flagged << " of " << tally.pixels
              << " flagged\n";
    CHECK(tally.flagged > tally.pixels / 8);
    CHECK(tally.far + tally.near == 0);
}

TEST_CASE("Where rounding decides whether a point is clipped the pixel is undecided") {
    // The pixel's point lies 2e-7 above the plane, at a depth of 6.8.
    const TemporaryFile file("clipped.h5");
    oracle::generate(R"({"generator": 1, "mesh": "waves", "shape": "prism", "elements": [3, 1, 3], "geometry_order": 2,
                         "order": 3, "field": "polynomial"})",
                     file.path());
    FrameRequest request;
    request.width = 800;
    request.height = part_rows;
    request.part = {128, 600};
    request.camera.orthographic = true;
    request.camera.eye = {5.431885167095755, 2.9420650823196084, -1.8778816359482224};
    request.camera.look_at = {0.058309762443411496, 0.05218803718335407, -0.13758143991906957};
    request.camera.up = {0.4736440479927679, -0.8807163651261537, 0.0};
    request.camera.height = 1.7096661582548434;
    Surface surface = colored_surface();
    surface.geometry = BoundaryFaces{};
    surface.clip = {{0.8056045145207483, -0.30142277736439294, -0.5100447779065335, 0.2965183885341587},
                    {-0.6922101203138301, -0.031832525840174604, 0.7209936474295369, -0.1610136218459199}};
    request.surfaces = {surface};
    const RuntimeVolume volume = oracle::open_volume(file.path());
    const Frame frame = Renderer(test::device(), volume, Precision::float32).render(request);
    const std::size_t pixel = (139 - 128) * 800 + 776;
    CHECK((frame.flags[pixel] & pixel_flag::undecided) != 0);
    // Few of those that the edges of the planes go through.
    CHECK(frame.counts.undecided_pixels < 8);
}

} // namespace elvis::hunt
