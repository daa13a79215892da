// Light of volumes in closed form: what is let through, whatever the elements are, and what hides and is hidden.
#include "isosurface.hpp"
#include "meshes.hpp"
#include "test_files.hpp"

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace elvis::oracle {
namespace {

const Device& device() {
    static const Device the_device;
    return the_device;
}

const Vector box_lower(-1, -1, -2), box_upper(1, 1, 4);

std::string box(const std::string& shape, const std::array<int, 3>& n) {
    return R"({"generator": 1, "mesh": "box", "shape": ")" + shape + R"(", "box": [[-1, -1, -2], [1, 1, 4]], "elements": [)" +
           std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]) +
           R"(], "order": 2, "geometry_order": 1, "field": "sphere"})";
}

FrameRequest request_of(const TransferFunction& transfer, std::uint32_t size = 96) {
    FrameRequest request;
    request.width = request.height = size;
    request.camera.eye = {7.3, 4.9, 5.6};
    request.camera.look_at = {0, 0, 1};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 42;
    request.background = {0.25, 0.5, 1, 1};
    request.volume.emplace();
    request.volume->transfer = transfer;
    return request;
}

/** Length of a ray in the box. */
double chord(const Line& ray, double until = 1e30) {
    double from = 0, to = until;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box_lower[axis] - ray.origin[axis]) / ray.direction[axis];
        const double b = (box_upper[axis] - ray.origin[axis]) / ray.direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return std::max(to - from, 0.0);
}

Line ray_of(const FrameRequest& request, std::size_t pixel) {
    return line_of(pixel_ray(request.camera, request.width, request.height, static_cast<std::uint32_t>(pixel % request.width),
                             static_cast<std::uint32_t>(pixel / request.width)));
}

/** Largest difference of a channel from a formula. */
template <class Formula> double largest_error(const FrameRequest& request, const Frame& frame, Formula formula) {
    double largest = 0;
    for (std::size_t pixel = 0; pixel < frame.counts.pixels; ++pixel) {
        const Color expected = formula(ray_of(request, pixel));
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const double error = std::abs(frame.color[4 * pixel + channel] - expected[channel]);
            largest = std::max(largest, std::isnan(error) ? 1e30 : error);
        }
    }
    return largest;
}

Color over(const std::array<double, 3>& rgb, double through, const Color& background) {
    return {(1 - through) * rgb[0] + through * background[0], (1 - through) * rgb[1] + through * background[1],
            (1 - through) * rgb[2] + through * background[2], 1};
}

} // namespace

TEST_CASE("a constant density lets through what its length says, whatever the elements") {
    const TemporaryFile file("constant.h5");
    const TransferFunction transfer{{{0, 0.3}}, {{0, {1, 0.5, 0}}}};
    for (const std::string shape : {"hexahedron", "prism", "pyramid", "tetrahedron", "mixed"}) {
        generate(box(shape, {4, 4, 6}), file.path());
        const RuntimeVolume volume = open_volume(file.path());
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            Renderer renderer(device(), volume, precision);
            const FrameRequest request = request_of(transfer);
            const Frame frame = renderer.render(request);
            const double error = largest_error(request, frame, [&](const Line& ray) {
                return over({1, 0.5, 0}, std::exp(-0.3 * chord(ray)), request.background);
            });
            if (std::getenv("DEV")) {
                for (std::size_t pixel = 0; pixel < frame.counts.pixels; ++pixel) {
                    const Line ray = ray_of(request, pixel);
                    const double e = std::abs(frame.color[4 * pixel] - over({1, 0.5, 0}, std::exp(-0.3 * chord(ray)), request.background)[0]);
                    if (e > 1e-6) {
                        std::printf("%s %d %zu chord %g error %g direction %g %g %g flags %u sign %g\n", shape.c_str(), int(precision), pixel, chord(ray), e, ray.direction[0], ray.direction[1], ray.direction[2], frame.flags[pixel], frame.color[4 * pixel]-over({1, 0.5, 0}, std::exp(-0.3 * chord(ray)), request.background)[0]);
                    }
                }
            }
            const std::size_t flagged = static_cast<std::size_t>(
                std::ranges::count_if(frame.flags, [](std::uint32_t flags) { return flags != 0; }));
            WARN(shape << (precision == Precision::float32 ? ", float32: " : ", float64: ") << error << ", " << frame.counts.volume_pixels
                       << " pixels, " << frame.counts.volume_segments << " segments, " << frame.counts.field_evaluations
                       << " evaluations, " << frame.counts.mapping_evaluations << " of the mapping, " << flagged << " flagged, " << frame.device_milliseconds << " ms");
            CHECK(frame.counts.volume_pixels > 1000);
            CHECK(error <= (precision == Precision::float32 ? 1e-6 : 1e-12));
            CHECK(flagged == 0);
        }
    }
}

} // namespace elvis::oracle
