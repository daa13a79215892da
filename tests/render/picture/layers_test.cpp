// Several surfaces in one picture.
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

namespace elvis::oracle {
namespace {

Surface plane(double z, const std::array<double, 3>& rgb, double opacity) {
    Surface surface;
    surface.geometry = CutPlane{{0, 0, 1, -z}};
    surface.colors.points = {{0, rgb}};
    surface.colors.below = surface.colors.above = {rgb[0], rgb[1], rgb[2], 1};
    surface.opacity = opacity;
    return surface;
}

} // namespace

TEST_CASE("surfaces show through each other in the order of depth, whatever their order in the scene") {
    VolumeData data;
    data.classes.push_back(make_class(space_of(native::Shape::hexahedron, 1), space_of(native::Shape::hexahedron, 1),
                                      cube(native::Shape::hexahedron, 2), [](const Vector& x) { return x.z(); }));
    const TemporaryFile file("layers.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request;
    request.width = request.height = 32;
    request.camera.orthographic = true;
    request.camera.height = 0.8;
    request.camera.eye = {0.51, 0.52, 4};
    request.camera.look_at = {0.51, 0.52, 0};
    request.camera.up = {0, 1, 0};
    request.background = {0, 0, 0, 1};
    std::vector<Surface> surfaces = {plane(0.9, {1, 0, 0}, 0.5), plane(0.7, {0, 1, 0}, 0.25), plane(0.4, {0, 0, 1}, 1),
                                     plane(0.2, {1, 1, 1}, 1)};
    // Only where x > 0.5.
    surfaces[1].clip = {{1, 0, 0, -0.5}};
    std::array<std::size_t, 4> order = {0, 1, 2, 3};
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Renderer renderer(device(), volume, precision);
        do {
            request.surfaces.clear();
            for (const std::size_t i : order)
                request.surfaces.push_back(surfaces[i]);
            const Frame frame = renderer.render(request);
            double color_error = 0, depth_error = 0, value_error = 0;
            for (std::size_t pixel = 0; pixel < 32 * 32; ++pixel) {
                const double x = 0.51 + 0.8 * ((double(pixel % 32) + 0.5) / 32 - 0.5);
                const double green = x > 0.5 ? 0.25 : 0.0;
                const std::array<double, 4> exact = {0.5, 0.5 * green, 0.5 * (1 - green), 1};
                for (std::size_t channel = 0; channel < 4; ++channel)
                    color_error = std::max(color_error, std::abs(frame.color[4 * pixel + channel] - exact[channel]));
                depth_error = std::max(depth_error, std::abs(frame.depth[pixel] - 3.1));
                value_error = std::max(value_error, std::abs(frame.value[pixel] - 0.9));
            }
            CHECK(color_error < 1e-6);
            CHECK(depth_error < 1e-6);
            CHECK(value_error < 1e-6);
        } while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST_CASE("the background has all digits of the precision beside and behind surfaces") {
    VolumeData data;
    data.classes.push_back(make_class(space_of(native::Shape::hexahedron, 1), space_of(native::Shape::hexahedron, 1),
                                      cube(native::Shape::hexahedron, 2), [](const Vector& x) { return x.z(); }));
    const TemporaryFile file("background.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request;
    request.width = request.height = 16;
    request.camera.eye = {0.51, 0.52, 4};
    request.camera.look_at = {0.51, 0.52, 0};
    request.camera.up = {0, 1, 0};
    request.background = {0.1, 0.2, 0.3, 1};
    const std::array<double, 3> red = {1, 0, 0};
    request.surfaces = {plane(0.9, red, 0.5), plane(0.5, red, 0.5)};
    request.surfaces[0].clip = {{1, 0, 0, -0.5}};
    request.surfaces[1].clip = {{0, 1, 0, -0.5}};
    const Frame frame = Renderer(device(), volume, Precision::float64).render(request);
    double error = 0;
    for (std::size_t pixel = 0; pixel < 16 * 16; ++pixel) {
        // Each layer before the background leaves half of it.
        const double red_share = (frame.color[4 * pixel] - request.background[0]) / (1 - request.background[0]);
        for (std::size_t channel = 1; channel < 3; ++channel)
            error = std::max(error, std::abs(frame.color[4 * pixel + channel] - (1 - red_share) * request.background[channel]));
    }
    CHECK(error < 1e-14);
}

} // namespace elvis::oracle
