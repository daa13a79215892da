/**
 * @file growth.hpp
 * What more elements cost: time a pixel, which should hardly grow, and memory a coefficient.
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace elvis {

struct GrowthOptions {
    /** Hexahedra along each side: 4096 to 4 million in all. */
    std::vector<std::uint32_t> elements_a_side{16, 32, 64, 128, 160};
    std::vector<std::uint32_t> orders{1, 2, 3};
    std::uint32_t size = 512;
};

/** One picture of one volume. */
struct GrowthRow {
    /** cut plane or isosurface. */
    std::string picture;
    std::uint64_t n_elements = 0;
    std::uint32_t order = 0;
    /** Least of some frames after the first; see bench.hpp. */
    double milliseconds = 0, wall_milliseconds = 0;
    std::uint64_t hit_pixels = 0;
    /** Of `milliseconds`, for a pixel that shows something. */
    double nanoseconds_a_pixel = 0;
    double evaluations_a_pixel = 0, newton_steps_a_pixel = 0;
    /** Until the first picture, from opening the volume on. */
    double first_milliseconds = 0;
    /** Of field and geometry together. */
    std::uint64_t n_coefficients = 0;
    /** After the picture: on the device, and in main memory beside what was there before the volume. Where the device is the
     * processor, without its own. */
    std::uint64_t device_bytes = 0, host_bytes = 0;

    double device_bytes_a_coefficient() const {
        return static_cast<double>(device_bytes) / static_cast<double>(n_coefficients);
    }
    double host_bytes_a_coefficient() const { return static_cast<double>(host_bytes) / static_cast<double>(n_coefficients); }
};

/** The bent cube of waves.hpp with straight edges (geometry order 1). Calls `report` after each picture. */
void bench_growth(const Device& device, const PluginRegistry& registry, const BenchFolder& folder, const GrowthOptions& options,
                  const std::function<void(const GrowthRow&)>& report);

} // namespace elvis
