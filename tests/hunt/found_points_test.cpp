// Points of surfaces in scenes in which the hunt found silent errors.
#include "found_scenes.hpp"

#include <core/oracle/isosurface/isosurface.hpp>
#include <core/oracle/samples/exact_volumes.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

namespace elvis::hunt {

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
    FrameRequest request = rows_of_parallel_view(48);
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
    const std::size_t pixel = pixel_in_rows(48, 58, 387);
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
    FrameRequest request = rows_of_parallel_view(128);
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
    const std::size_t pixel = pixel_in_rows(128, 139, 776);
    CHECK((frame.flags[pixel] & pixel_flag::undecided) != 0);
    // Few of those that the edges of the planes go through.
    CHECK(frame.counts.undecided_pixels < 8);
}

} // namespace elvis::hunt
