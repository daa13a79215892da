// Where surfaces without end that are shown outside of elements end, too: a box around the volume.
#include <core/oracle/element/volume.hpp>
#include <core/oracle/picture/view.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {

namespace {

constexpr std::uint32_t size = 201;
constexpr const char* description =
    R"({"generator": 1, "mesh": "box", "shape": "hexahedron", "elements": [2, 2, 2], "order": 1, "field": "polynomial"})";

/** Of the box [-1, 1]^3 three times. */
FrameRequest view_at_end(const Model& model, const SurfaceGeometry& geometry, const Vector3& end) {
    FrameRequest request = view_of(model, CutPlane{{0, 0, 1, 0}}, size, size, 0, 1);
    request.surfaces[0].geometry = geometry;
    request.surfaces[0].outside = {0.5, 0.5, 0.5};
    request.camera.look_at = end;
    return request;
}

bool is_undecided(const Frame& frame, std::size_t pixel) { return (frame.flags[pixel] & pixel_flag::undecided) != 0; }

} // namespace

TEST_CASE("pixels at the end of a plane that is shown outside of elements are undecided") {
    const TemporaryFile file("box.h5");
    generate(description, file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(read_volume(file.path()));
    FrameRequest request = view_at_end(model, CutPlane{{0, 0, 1, 0}}, {3, 0, 0});
    request.camera.orthographic = true;
    request.camera.height = 0.01 * size;
    request.camera.eye = {3, 0, 5};
    request.camera.up = {0, 1, 0};
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        const Frame frame = Renderer(device(), volume, precision).render(request);
        std::size_t n_wrong = 0;
        for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
            const std::size_t column = pixel % size, end = size / 2;
            const bool is_right = column == end
                                      ? is_undecided(frame, pixel)
                                      : !is_undecided(frame, pixel) && std::isfinite(frame.depth[pixel]) == (column < end);
            n_wrong += is_right ? 0 : 1;
        }
        INFO(name_of(precision));
        CHECK(n_wrong == 0);
    }
}

TEST_CASE("where rounding decides whether an endless quadric is seen, the pixel is undecided") {
    const TemporaryFile file("box.h5");
    generate(description, file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(read_volume(file.path()));
    Renderer single(device(), volume, Precision::float32), precise(device(), volume, Precision::float64);
    std::size_t n_shown = 0, n_undecided = 0, n_wrong = 0;
    for (std::size_t turn = 0; turn < 10; ++turn) {
        const double angle = 0.1 + 0.23 * static_cast<double>(turn), c = std::cos(angle), s = std::sin(angle);
        // (c x + s y)^2 + z^2 = 1/4
        const Quadric cylinder{{c * c, s * s, 1, 2 * c * s, 0, 0, 0, 0, 0, -0.25}};
        const Vector3 end = std::abs(s) > std::abs(c) ? Vector3{3, -3 * c / s, 0.5} : Vector3{-3 * s / c, 3, 0.5};
        FrameRequest request = view_at_end(model, CutShape(cylinder), end);
        // So close that rounding is some hundredths of a pixel.
        request.camera.eye = {end[0] + 9, end[1] + 7, end[2] + 8};
        request.camera.field_of_view = 0.03;
        const Frame frame = single.render(request), exact = precise.render(request);
        for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
            const bool is_shown = std::isfinite(exact.depth[pixel]);
            n_shown += is_shown ? 1 : 0;
            n_undecided += is_undecided(frame, pixel) ? 1 : 0;
            n_wrong += std::isfinite(frame.depth[pixel]) != is_shown && !is_undecided(frame, pixel) ? 1 : 0;
        }
    }
    WARN(n_shown << " shown, " << n_undecided << " undecided, " << n_wrong << " wrong");
    CHECK(n_shown > 100000);
    CHECK(n_undecided < 1000);
    CHECK(n_wrong == 0);
}

} // namespace elvis::oracle
