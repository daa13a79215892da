#include "face_accuracy.hpp"

#include <core/render/renderer.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace elvis::oracle {

std::vector<elvis_face> faces_of(const RuntimeVolume& volume) {
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    return faces;
}

namespace {

FrameRequest request_of(const Boundary& boundary, std::uint32_t size) {
    FrameRequest request;
    request.width = request.height = size;
    const Vector eye = boundary.centre() + 0.9 * boundary.size() * Vector(0.8, 0.55, 0.5).normalized();
    request.camera.eye = {eye.x(), eye.y(), eye.z()};
    request.camera.look_at = {boundary.centre().x(), boundary.centre().y(), boundary.centre().z()};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 50;
    Surface surface;
    surface.geometry = BoundaryFaces{};
    surface.colors.points = {{0, {0, 0, 0}}};
    request.surfaces = {surface};
    return request;
}

/** Rays through points of edges: none may see what is behind. */
void measure_edges(Renderer& renderer, FrameRequest request, const Boundary& boundary, std::mt19937& random,
                   std::size_t n_edge_rays, double allowed, FaceAccuracy& result) {
    const Vector eye(request.camera.eye[0], request.camera.eye[1], request.camera.eye[2]);
    request.width = request.height = 1;
    for (std::size_t k = 0; k < n_edge_rays; ++k) {
        const Boundary::EdgePoint point = boundary.edge_point(random, k % 2 == 1);
        const Vector towards = point.position - eye;
        const double distance = towards.norm(), facing = std::abs(point.normal.dot(towards)) / distance;
        if (facing < 0.01)
            continue;
        ++result.n_edge_rays;
        request.camera.look_at = {point.position.x(), point.position.y(), point.position.z()};
        const Frame one = renderer.render(request);
        const double behind = one.element[0] < 0 ? 1 : (one.depth[0] - distance) * facing / boundary.size();
        result.n_leaks += behind > allowed;
        result.leak_depth_error = std::max(result.leak_depth_error, behind);
    }
}

} // namespace

FaceAccuracy measure_faces(const Device& device, const RuntimeVolume& volume, const Boundary& boundary, Precision precision,
                           std::uint32_t size, std::size_t n_pixels, std::size_t n_edge_rays) {
    const FrameRequest request = request_of(boundary, size);
    Renderer renderer(device, volume, precision);
    const Frame frame = renderer.render(request);
    FaceAccuracy result;
    result.n_careful = frame.counts.careful_pixels;
    result.n_flagged =
        static_cast<std::size_t>(std::ranges::count_if(frame.flags, [](std::uint32_t flags) { return flags != 0; }));

    std::mt19937 random(20);
    std::vector<std::size_t> pixels(frame.depth.size());
    std::iota(pixels.begin(), pixels.end(), std::size_t{0});
    std::shuffle(pixels.begin(), pixels.end(), random);
    pixels.resize(std::min(n_pixels, pixels.size()));
    result.n_pixels = pixels.size();
    // What rounding of positions, 1e-7 or 1e-16 of the size, makes of a touching ray: the square root of it.
    const double touching = precision == Precision::float64 ? 1e-6 : 2e-3;
    for (const std::size_t pixel : pixels) {
        const Ray ray = pixel_ray(request.camera, size, size, static_cast<std::uint32_t>(pixel % size),
                                  static_cast<std::uint32_t>(pixel / size));
        const auto exact = boundary.hit(ray);
        const bool is_drawn = frame.element[pixel] >= 0;
        if (!is_drawn || !exact) {
            const bool is_touching =
                exact ? exact->facing < touching
                      : is_drawn && boundary.distance((ray.origin + frame.depth[pixel] * ray.direction).cast<double>()) <
                                        touching * touching * boundary.size();
            result.n_missed += !is_drawn && exact && !is_touching;
            result.n_invented += is_drawn && !exact && !is_touching;
            result.n_touching += is_drawn != exact.has_value() && is_touching;
            continue;
        }
        ++result.n_hits;
        const double error = std::abs(frame.depth[pixel] - exact->distance);
        if (exact->facing >= 0.05) {
            result.depth_error = std::max(result.depth_error, error / boundary.size());
        } else {
            const Vector x = (ray.origin + frame.depth[pixel] * ray.direction).cast<double>();
            result.grazing_error = std::max(result.grazing_error, boundary.distance(x) / frame.depth[pixel]);
        }
    }

    measure_edges(renderer, request, boundary, random, n_edge_rays, precision == Precision::float64 ? 1e-12 : 1e-6, result);
    return result;
}

} // namespace elvis::oracle
