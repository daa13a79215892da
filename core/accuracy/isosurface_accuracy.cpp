#include "isosurface_accuracy.hpp"

#include <core/base/temporary_folder.hpp>
#include <core/oracle/samples/meshes.hpp>

#include <core/render/renderer.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::oracle {
namespace {

Surface surface_of(std::vector<double> values) {
    Surface surface;
    surface.geometry = Isosurfaces{{}, std::move(values)};
    surface.colors.points = {{0, {0, 0, 0}}};
    surface.colors.below = surface.colors.above = surface.colors.nan = {0, 0, 0, 1};
    return surface;
}

} // namespace

FrameRequest isosurface_request(const RandomVolume& random, std::uint32_t size, IsosurfaceMethod method) {
    FrameRequest request;
    request.width = request.height = size;
    request.camera = random.camera;
    request.surfaces = {surface_of(random.values)};
    std::get<Isosurfaces>(request.surfaces[0].geometry).method = method;
    request.surfaces[0].clip = random.clip;
    return request;
}

RandomAccuracy measure_random(const Device& device, const PluginRegistry& registry, const RandomVolume& random,
                              std::uint32_t size, std::span<const Precision> precisions, IsosurfaceMethod method) {
    const TemporaryFile file("random.h5");
    write_volume(file.path(), random.data);
    const RuntimeVolume volume(registry.runtime_for(file.path()), file.path());
    const Model model(random.data);
    IsosurfaceTracer tracer(model, {scalar_of_field(model.volume, 0), random.values, random.clip});
    const IsosurfacePicture exact = draw_isosurface(model, tracer.isosurface(), random.camera, size, size);
    RandomAccuracy result;
    result.oracle_seconds = exact.seconds;
    result.oracle_failures = exact.n_failures;
    for (const Precision precision : precisions) {
        Renderer renderer(device, volume, precision);
        const Frame frame = renderer.render(isosurface_request(random, size, method));
        const IsosurfaceTolerance& tolerance = precision == Precision::float64 ? float64_tolerance : float32_tolerance;
        result.comparisons.push_back(compare(tracer, exact, random.camera, frame, tolerance));
        result.counts.push_back(frame.counts);
        result.render_milliseconds.push_back(frame.render_milliseconds);
    }
    return result;
}

SphereAccuracy measure_sphere(const Device& device, const RuntimeVolume& volume, Precision precision, const Camera& camera,
                              std::uint32_t size) {
    FrameRequest request;
    request.width = request.height = size;
    request.camera = camera;
    request.surfaces = {surface_of({1})};
    Renderer renderer(device, volume, precision);
    const Frame frame = renderer.render(request);
    SphereAccuracy result;
    for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
        const Ray ray =
            pixel_ray(camera, size, size, static_cast<std::uint32_t>(pixel % size), static_cast<std::uint32_t>(pixel / size));
        const bool is_hit = frame.element[pixel] >= 0;
        const long double middle = -ray.origin.dot(ray.direction);
        const long double r2 = (ray.origin + middle * ray.direction).squaredNorm();
        const bool is_seen = r2 <= 1 && middle + std::sqrt(1 - r2) > 0;
        const bool is_flagged = (frame.flags[pixel] & pixel_flag::isosurface_undecided) != 0;
        const bool is_missed = is_seen && r2 < 0.9999L && !is_hit;
        const bool is_invented = (r2 > 1.0001L || (!is_seen && r2 < 0.9999L)) && is_hit;
        result.n_hits += is_hit;
        result.n_flagged += is_flagged;
        result.n_missed += is_missed;
        result.n_invented += is_invented;
        result.n_wrong_flagged += is_flagged && (is_missed || is_invented);
        if (!is_hit)
            continue;
        const LongVector shown = ray.origin + static_cast<long double>(frame.depth[pixel]) * ray.direction;
        const long double half = std::sqrt(std::max(1 - r2, 0.0L));
        // |n.d| is half, for the radius 1.
        if (half < grazing) {
            result.grazing_error =
                std::max(result.grazing_error, static_cast<double>(std::abs(shown.norm() - 1) / frame.depth[pixel]));
            continue;
        }
        const bool is_inside = ray.origin.squaredNorm() < 1;
        const long double exact = is_inside ? middle + half : middle - half;
        const auto off = static_cast<double>(std::abs(frame.depth[pixel] - exact));
        if (is_flagged) {
            result.n_wrong_flagged += off > 1e-3;
            continue;
        }
        const LongVector normal = (is_inside ? -1 : 1) * (ray.origin + exact * ray.direction);
        const LongVector drawn(frame.normal[3 * pixel], frame.normal[3 * pixel + 1], frame.normal[3 * pixel + 2]);
        result.depth_error = std::max(result.depth_error, off);
        result.normal_error = std::max(result.normal_error, static_cast<double>((drawn - normal).norm()));
    }
    return result;
}

} // namespace elvis::oracle
