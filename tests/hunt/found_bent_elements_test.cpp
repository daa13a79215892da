// Isosurfaces in strongly bent elements, of which the hunt found many pixels undecided.
#include "found_scenes.hpp"
#include "volumes.hpp"

#include <catch2/catch.hpp>

#include <iostream>

namespace elvis::hunt {

namespace {

FrameRequest request_of(const Isosurfaces& isosurfaces, const Vector3& eye, const Vector3& look_at, const Vector3& up,
                        double field_of_view) {
    FrameRequest request;
    request.width = 48;
    request.height = 36;
    request.camera.eye = eye;
    request.camera.look_at = look_at;
    request.camera.up = up;
    request.camera.field_of_view = field_of_view;
    Surface surface = colored_surface();
    surface.geometry = isosurfaces;
    request.surfaces = {surface};
    return request;
}

void check(const Tally& tally) {
    std::cout << "bent elements: " << tally.hits << " hits, " << tally.flagged << " of " << tally.pixels << " flagged\n";
    CHECK(tally.hits > tally.pixels / 50);
    CHECK(tally.far + tally.near == 0);
    CHECK(tally.flagged <= tally.pixels / 200);
}

} // namespace

TEST_CASE("What projection leaves open in strongly bent elements is found by intervals") {
    // Six tetrahedra of geometry order 2. A quarter of the surface was undecided.
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const IsosurfaceMethod method = GENERATE(IsosurfaceMethod::bernstein, IsosurfaceMethod::companion);
    const TemporaryFile file("tetrahedra.h5");
    const PluginRegistry plugins;
    make_volume(plugins, 35000, {}, file.path());
    const Isosurfaces isosurfaces{.values = {-1.9167, -1.1456}, .method = method};
    const FrameRequest request =
        request_of(isosurfaces, {2.794, -2.395, -1.457}, {0.008, -0.251, -0.069}, {-0.61, -0.793, 0}, 36.4);
    check(judge_picture(file.path(), request, precision));
}

TEST_CASE("Strongly bent elements are divided though nothing is skipped") {
    // More than a quarter of the pixels were undecided.
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("hemisphere.h5");
    oracle::generate(R"({"generator": 1, "mesh": "hemisphere", "shape": "pyramid", "elements": [3, 1, 3], "layers": 2,)"
                     R"( "order": 4, "geometry_order": 4, "field": "sphere"})",
                     file.path());
    const Isosurfaces isosurfaces{.values = {0.4275}, .skips_by_range = false};
    const FrameRequest request =
        request_of(isosurfaces, {0.838, -1.952, -0.027}, {0.123, 0.103, 0.378}, {-0.945, -0.328, 0}, 63.5);
    check(judge_picture(file.path(), request, precision));
}

TEST_CASE("Fields of high order in strongly bent elements are decided in single precision") {
    // A field of order 10 in six tetrahedra: 11 % of the pixels were undecided, because intervals ended when they were short,
    // and not when rounding was all that was left.
    const TemporaryFile file("tetrahedra.h5");
    const PluginRegistry plugins;
    make_volume(plugins, 16682, {}, file.path());
    const FrameRequest request = request_of(Isosurfaces{.values = {1.5832}}, {-0.2188, -3.738, 1.1245},
                                            {-0.128, 0.1152, -0.0716}, {-1, 0.0235, 0}, 49.3);
    check(judge_picture(file.path(), request, Precision::float32));
}

TEST_CASE("Behind a layer that is found again another isovalue is not missed") {
    // One pixel in a hundred lost a layer: the interval in which both lie was left with the first one.
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const TemporaryFile file("layers.h5");
    const PluginRegistry plugins;
    make_volume(plugins, 38341, {}, file.path());
    FrameRequest request = request_of(Isosurfaces{.values = {0.8087626535223886, 0.8222959236404592, 1.0300539138859814}},
                                      {-1.8151, 1.3356, 2.3096}, {0.0032, -0.0424, 0.1786}, {0.604, 0.797, 0}, 37.8);
    request.surfaces[0].opacity = 0.45;
    check(judge_picture(file.path(), request, precision));
}

} // namespace elvis::hunt
