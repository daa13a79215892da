/**
 * @file isosurface_accuracy.hpp
 * Isosurfaces drawn by the program against the oracle's and against closed forms.
 */
#pragma once

#include <core/oracle/isosurface/isosurface_compare.hpp>
#include <core/oracle/samples/random_volumes.hpp>

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis::oracle {

/** The view of a random volume as the renderer is asked for it. */
FrameRequest isosurface_request(const RandomVolume& random, std::uint32_t size,
                                IsosurfaceMethod method = IsosurfaceMethod::interval);

/** A random volume drawn in each precision, and by the oracle once. */
struct RandomAccuracy {
    /** One a precision. */
    std::vector<IsosurfaceComparison> comparisons;
    std::vector<double> render_milliseconds;
    std::vector<FrameCounts> counts;
    double oracle_seconds = 0;
    std::uint64_t oracle_failures = 0;
};
RandomAccuracy measure_random(const Device& device, const PluginRegistry& registry, const RandomVolume& random,
                              std::uint32_t size, std::span<const Precision> precisions,
                              IsosurfaceMethod method = IsosurfaceMethod::interval);

/** The sphere |x| = 1 as isosurface of a volume whose field is |x|^2, in closed form. */
struct SphereAccuracy {
    std::size_t n_hits = 0, n_flagged = 0;
    /** Rays at a distance r from the origin with r^2 < 0.9999 that show nothing, and with r^2 > 1.0001 that show something. */
    std::size_t n_missed = 0, n_invented = 0;
    /** Flagged pixels among those, and others that show a point of another sheet. */
    std::size_t n_wrong_flagged = 0;
    /** Where |normal . direction| >= 0.05, but for flagged pixels. */
    double depth_error = 0, normal_error = 0;
    /** Elsewhere: | |x| - 1 | over the distance from the eye. */
    double grazing_error = 0;
};
SphereAccuracy measure_sphere(const Device& device, const RuntimeVolume& volume, Precision precision, const Camera& camera,
                              std::uint32_t size);

} // namespace elvis::oracle
