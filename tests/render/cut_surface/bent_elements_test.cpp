// Planes through strongly bent elements, in which Newton's method can take points for outside.
#include <core/oracle/element/volume.hpp>
#include <core/oracle/picture/view.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

namespace elvis::oracle {

namespace {

constexpr std::uint32_t unsure = pixel_flag::newton_failure | pixel_flag::undecided;

std::size_t n_holes(const Picture& exact, const Frame& frame) {
    std::size_t n = 0;
    for (std::size_t pixel = 0; pixel < frame.element.size(); ++pixel) {
        n += exact.is_inside[pixel] != 0 && frame.element[pixel] < 0 && (frame.flags[pixel] & unsure) == 0;
    }
    return n;
}

std::size_t n_unsure(const Frame& frame) {
    return static_cast<std::size_t>(
        std::ranges::count_if(frame.flags, [](std::uint32_t flags) { return (flags & unsure) != 0; }));
}

} // namespace

TEST_CASE("a plane has no hole in strongly bent pyramids") {
    const TemporaryFile file("torus.h5");
    generate(R"({"generator": 1, "mesh": "torus", "shape": "pyramid", "elements": [3, 1, 4], "layers": 2,
                 "geometry_order": 4, "order": 2, "field": "polynomial"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(read_volume(file.path()));
    const FrameRequest request = view_of(model, CutPlane{{0.03, 0.02, 1, 0.05}}, 80, 80, 0, 3);
    const Picture exact = draw(model, request);
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        const Frame frame = Renderer(device(), volume, precision).render(request);
        INFO(name_of(precision));
        CHECK(n_holes(exact, frame) == 0);
        CHECK(n_unsure(frame) < frame.element.size() / 50);
    }
}

namespace {

struct BentVolume {
    const char* description;
    CutPlane plane;
    Precision precision; // in which it is drawn where not both are
};
const BentVolume bent_volumes[] = {
    {R"({"generator": 1, "mesh": "ball", "shape": "tetrahedron", "elements": [2, 2, 2], "geometry_order": 3, "order": 2,
         "field": "polynomial"})",
     {{0.03, 0.02, 1, 0.05}},
     Precision::float64},
    {R"({"generator": 1, "mesh": "torus", "shape": "pyramid", "elements": [3, 1, 4], "layers": 2, "geometry_order": 4,
         "order": 2, "field": "polynomial"})",
     {{0.03, 0.02, 1, 0.05}},
     Precision::float32},
    {R"({"generator": 1, "mesh": "torus", "shape": "hexahedron", "elements": [2, 2, 3], "geometry_order": 4, "order": 2,
         "field": "polynomial"})",
     {{1, 0.4, 0.3, 0.1}},
     Precision::float32},
};

void check_second_picture(const BentVolume& bent, Precision precision) {
    const TemporaryFile file("bent.h5");
    generate(bent.description, file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(read_volume(file.path()));
    const FrameRequest request = view_of(model, bent.plane, 80, 80, 0, 3);
    const Picture exact = draw(model, request);
    Renderer renderer(device(), volume, precision);
    const Frame first = renderer.render(request), second = renderer.render(request);
    INFO(bent.description << " " << name_of(precision));
    CHECK(n_holes(exact, second) == 0);
    CHECK(second.element == first.element);
    CHECK(second.flags == first.flags);
    CHECK(second.counts.newton_iterations < first.counts.newton_iterations);
}

} // namespace

TEST_CASE("what a picture has found out about bent elements spares the next one work and no pixel") {
    for (const BentVolume& bent : bent_volumes) {
        check_second_picture(bent, bent.precision);
    }
}

TEST_CASE("what a picture has found out about bent elements spares work in both precisions", "[.long]") {
    for (const BentVolume& bent : bent_volumes) {
        check_second_picture(bent, Precision::float32);
        check_second_picture(bent, Precision::float64);
    }
}

} // namespace elvis::oracle
