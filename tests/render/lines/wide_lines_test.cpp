// Wide lines beside closed forms: the pixels with their centre within half of the width.
#include "lines.hpp"
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <functional>
#include <iostream>

namespace elvis::oracle {
namespace {

using native::Shape;

constexpr std::uint32_t wide_picture_size = 120;

/** Distance of a pixel's middle from a line on the plane, in pixels. */
using Distance = std::function<double(std::uint32_t column, std::uint32_t row)>;

/** One pixel is so large on the plane. */
constexpr double pixel_size = 1.0 / 100;

/** The plane seen from above: a pixel is a square on it, wherever it is. */
FrameRequest from_above(double turned) {
    FrameRequest request;
    request.width = request.height = wide_picture_size;
    request.camera.orthographic = true;
    request.camera.height = wide_picture_size * pixel_size;
    // Away from where lines and pixels are symmetric to each other.
    request.camera.eye = {0.4937, 0.5071, 3};
    request.camera.look_at = {0.4937, 0.5071, plane_z};
    request.camera.up = {std::sin(turned), std::cos(turned), 0};
    Surface plane;
    plane.geometry = CutPlane{{0, 0, 1, -plane_z}};
    plane.colors.points = {{-9, {0, 0, 0}}, {9, {0, 0, 0}}};
    request.surfaces.push_back(plane);
    return request;
}

Vector middle_of(const FrameRequest& request, std::uint32_t column, std::uint32_t row) {
    const Ray ray = pixel_ray(request.camera, wide_picture_size, wide_picture_size, column, row);
    return (ray.origin + (plane_z - ray.origin.z()) / ray.direction.z() * ray.direction).cast<double>();
}

/** White lines on black: how far pixels that are drawn wrong are from half of the width, in pixels; and how many there are. */
struct Rim {
    double farthest = 0, mean = 0;
    std::size_t n_wrong = 0, n_drawn = 0;
};

Rim rim_of(const FrameRequest& request, const Frame& frame, double width, const Distance& distance) {
    Rim rim;
    double area = 0;
    for (std::uint32_t row = 0; row < wide_picture_size; ++row) {
        for (std::uint32_t column = 0; column < wide_picture_size; ++column) {
            const Vector x = middle_of(request, column, row);
            // Nothing of the volume is seen beyond, where the line goes on.
            if (std::min({x.x(), x.y(), 1 - x.x(), 1 - x.y()}) < (0.5 * width + 3) * pixel_size) {
                continue;
            }
            const bool is_drawn = frame.color[4 * (std::size_t{row} * wide_picture_size + column)] > 0.5;
            const double beyond = distance(column, row) - 0.5 * width;
            rim.n_drawn += is_drawn;
            area += beyond <= 0 ? 1 : 0;
            if (is_drawn != (beyond <= 0)) {
                ++rim.n_wrong;
                rim.farthest = std::max(rim.farthest, std::abs(beyond));
            }
        }
    }
    rim.mean = static_cast<double>(rim.n_drawn) / area;
    return rim;
}

constexpr LineStyle white(double width) { return {width, std::array<double, 3>{1, 1, 1}, std::nullopt}; }

VolumeData cubes(std::uint32_t n, const std::function<Vector(const Vector&)>& bent, const Function& function) {
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 2),
                                      compose(cube(Shape::hexahedron, n), bent), function));
    return data;
}

const auto straight = [](const Vector& x) -> Vector { return x; };

} // namespace

TEST_CASE("Wide contours are as wide as they are said to be, whatever their direction, and bend round") {
    const double radius = 0.21;
    const TemporaryFile file("wide_contours.h5");
    write_volume(file.path(), cubes(3, straight, [](const Vector& x) {
                     return (x.x() - 0.47) * (x.x() - 0.47) + (x.y() - 0.52) * (x.y() - 0.52);
                 }));
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(device(), volume, Precision::float32);
    for (const double width : {1.6, 2.0, 3.0, 4.0, 5.5, 8.0, 13.0}) {
        FrameRequest request = from_above(0.3);
        request.surfaces[0].contours = Contours{{radius * radius}, white(width)};
        const Rim rim = rim_of(request, renderer.render(request), width, [&](std::uint32_t column, std::uint32_t row) {
            const Vector x = middle_of(request, column, row);
            return std::abs(std::hypot(x.x() - 0.47, x.y() - 0.52) - radius) / pixel_size;
        });
        std::cout << "contour of width " << width << ": " << rim.n_drawn << " pixels, " << rim.n_wrong << " of them wrong, by "
                  << rim.farthest << " at most; area times " << rim.mean << '\n';
        CHECK(rim.n_drawn > 100);
        CHECK(rim.farthest < 0.05);
    }
}

TEST_CASE("Wide mesh lines are as wide as they are said to be to less than half a pixel, whatever their direction") {
    const TemporaryFile file("wide_mesh_lines.h5");
    write_volume(file.path(), cubes(2, straight, [](const Vector& x) { return x.x(); }));
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(device(), volume, Precision::float32);
    double farthest = 0;
    for (const double turned : {0.0, 0.02, 0.2, 0.46, 0.7, 0.785398}) {
        for (const double width : {2.0, 3.0, 4.0, 8.0, 13.0}) {
            FrameRequest request = from_above(turned);
            request.surfaces[0].mesh_lines = MeshLines{white(width)};
            // Two lines that cross.
            const Rim rim = rim_of(request, renderer.render(request), width, [&](std::uint32_t column, std::uint32_t row) {
                const Vector x = middle_of(request, column, row);
                return std::min(std::abs(x.x() - 0.5), std::abs(x.y() - 0.5)) / pixel_size;
            });
            std::cout << "mesh lines turned by " << turned << ", of width " << width << ": " << rim.n_drawn << " pixels, "
                      << rim.n_wrong << " wrong, by " << rim.farthest << " at most; area times " << rim.mean << '\n';
            farthest = std::max(farthest, rim.farthest);
            // Along diagonals, all pixels that the line meets tell the same of where it is.
            CHECK(rim.mean == Approx(1).margin(turned == 0.785398 ? 0.35 : 0.1));
        }
    }
    CHECK(farthest < 0.5);
}

TEST_CASE("Where a wide contour ends, its end is round") {
    // At a jump between elements, which no contour crosses.
    const TemporaryFile file("wide_end.h5");
    const auto left = [](const Vector& x) -> Vector { return {0.5 * x.x(), x.y(), x.z()}; };
    const auto right = [](const Vector& x) -> Vector { return {0.5 + 0.5 * x.x(), x.y(), x.z()}; };
    VolumeData data = cubes(1, left, [](const Vector& x) { return x.y() - 0.53; });
    data.classes.push_back(cubes(1, right, [](const Vector& x) { return x.y() + 5; }).classes[0]);
    data.classes[1].numbers = {1};
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(device(), volume, Precision::float32);
    const double width = 16;
    FrameRequest request = from_above(0.2);
    request.surfaces[0].contours = Contours{{0}, white(width)};
    const Rim rim = rim_of(request, renderer.render(request), width, [&](std::uint32_t column, std::uint32_t row) {
        const Vector x = middle_of(request, column, row);
        return std::hypot(std::max(0.0, x.x() - 0.5), x.y() - 0.53) / pixel_size;
    });
    std::cout << "end of a contour: " << rim.n_drawn << " pixels, " << rim.n_wrong << " wrong, by " << rim.farthest
              << " at most\n";
    CHECK(rim.farthest < 1);
    CHECK(40 * rim.n_wrong < rim.n_drawn);
}

TEST_CASE("Lines that are too wide to be drawn are refused") {
    const TemporaryFile file("too_wide.h5");
    write_volume(file.path(), cubes(1, straight, [](const Vector& x) { return x.x(); }));
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(device(), volume, Precision::float32);
    FrameRequest request = from_above(0);
    request.surfaces[0].mesh_lines = MeshLines{white(177)};
    CHECK_THROWS_WITH(renderer.render(request), Catch::Contains("a width of 177 pixels"));
    request.surfaces[0].mesh_lines = MeshLines{white(176)};
    CHECK(renderer.render(request).counts.work_limit_pixels == 0);
}

} // namespace elvis::oracle
