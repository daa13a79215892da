// Scenes with fields of high order in which the hunt found silent errors, or false alarms.
#include "found_scenes.hpp"
#include "scenes.hpp"
#include "volumes.hpp"

#include <core/oracle/isosurface/isosurface.hpp>
#include <core/scene/frame_request.hpp>

#include <catch2/catch.hpp>

#include <iostream>

namespace elvis::hunt {

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

TEST_CASE("Isosurfaces in strongly bent tetrahedra are decided at nearly all pixels") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("torus.h5");
    oracle::generate(R"({"generator": 1, "mesh": "torus", "shape": "tetrahedron", "elements": [4, 2, 12], "geometry_order": 3,
                         "order": 4, "field": "waves"})",
                     file.path());
    FrameRequest request = request_of_rough_field({2.6, 2.1, 1.9}, {0, 0, 0}, {0, 0, 1}, 40);
    Surface surface = colored_surface();
    surface.geometry = Isosurfaces{.values = {0.1}};
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, precision);
    std::cout << "torus of tetrahedra: " << tally.flagged << " of " << tally.pixels << " flagged, " << tally.hits << " hits\n";
    CHECK(tally.hits > tally.pixels / 10);
    CHECK(tally.far + tally.near == 0);
    // Was a fifth of all pixels.
    CHECK(tally.flagged <= tally.hits / 100);
}

TEST_CASE("Isosurfaces in long thin tetrahedra that bend along their length are decided") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("long.h5");
    oracle::generate(R"({"generator": 1, "mesh": "torus", "shape": "tetrahedron", "elements": [6, 2, 8], "layers": 2,
                         "geometry_order": 2, "order": 3, "field": "waves"})",
                     file.path());
    FrameRequest request = request_of_rough_field({2.6, 2.1, 1.9}, {0, 0, 0}, {0, 0, 1}, 40);
    Surface surface = colored_surface();
    surface.geometry = Isosurfaces{.values = {0.4}};
    request.surfaces = {surface};
    const Tally tally = judge_picture(file.path(), request, precision);
    std::cout << "long tetrahedra: " << tally.flagged << " of " << tally.pixels << " flagged, " << tally.hits << " hits\n";
    CHECK(tally.hits > tally.pixels / 10);
    CHECK(tally.far + tally.near == 0);
    // Was a fifth of all pixels.
    CHECK(tally.flagged <= tally.hits / 100);
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

} // namespace elvis::hunt
