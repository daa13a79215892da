#include "root_finders.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

namespace elvis::oracle {
namespace {

void compare(const RayAnswer& series, const RayAnswer& other, double range, std::size_t& n_differ, double& error) {
    const auto &a = series.crossing, &b = other.crossing;
    if (a.has_value() != b.has_value() || (a && (a->element != b->element || a->value != b->value)))
        ++n_differ;
    else if (a)
        error = std::max(error, std::abs(a->t - b->t) * a->facing * a->slope / range);
}

} // namespace

FinderComparison& FinderComparison::operator+=(const FinderComparison& other) {
    n_rays += other.n_rays;
    n_hits += other.n_hits;
    n_samples_differ += other.n_samples_differ;
    n_companion_differ += other.n_companion_differ;
    samples_error = std::max(samples_error, other.samples_error);
    companion_error = std::max(companion_error, other.companion_error);
    n_failures += other.n_failures;
    return *this;
}

FinderComparison compare_finders(const Model& model, const Isosurface& isosurface, const Camera& camera, std::uint32_t width,
                                 std::uint32_t height, std::uint32_t stride) {
    const std::uint32_t n_threads = std::max(1u, std::thread::hardware_concurrency());
    std::vector<FinderComparison> results(n_threads);
    {
        std::vector<std::jthread> threads;
        for (std::uint32_t thread = 0; thread < n_threads; ++thread)
            threads.emplace_back([&, thread] {
                IsosurfaceTracer tracer(model, isosurface);
                FinderComparison& result = results[thread];
                for (std::uint32_t pixel = thread * stride; pixel < width * height; pixel += n_threads * stride) {
                    const Line line = line_of(pixel_ray(camera, width, height, pixel % width, pixel / width));
                    const RayAnswer series = tracer.first(line);
                    ++result.n_rays;
                    result.n_hits += series.crossing.has_value();
                    compare(series, tracer.first(line, RootFinder::samples), tracer.range(), result.n_samples_differ,
                            result.samples_error);
                    compare(series, tracer.first(line, RootFinder::companion), tracer.range(), result.n_companion_differ,
                            result.companion_error);
                }
                result.n_failures = tracer.n_failures();
            });
    }
    FinderComparison sum;
    for (const FinderComparison& result : results)
        sum += result;
    return sum;
}

} // namespace elvis::oracle
