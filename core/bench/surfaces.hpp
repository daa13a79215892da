/**
 * @file surfaces.hpp
 * The measurements of B. Nelson's dissertation (Utah, 2012), chapter 5, on the waves volumes: which contour pixels stay
 * undecided (its figures 5.3 and 5.4), and what time and memory pictures take (5.9 to 5.11).
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace elvis {

struct SurfacesOptions {
    /** What is not varied. */
    std::uint32_t elements_a_side = 16;
    std::uint32_t order = 6;
    std::uint32_t size = 1024;
    /** What is. */
    std::vector<std::uint32_t> sizes{256, 512, 1024, 2048};
    std::vector<std::uint32_t> orders{2, 4, 6, 8, 10};
    std::vector<std::uint32_t> elements{4, 8, 16, 24, 32};
    /** Of the contours: few elements, so that a higher order means more in each of them. */
    std::uint32_t contour_elements_a_side = 4;
    std::vector<std::uint32_t> contour_orders{2, 4, 6, 8};
    std::uint32_t most_subdivisions = 8;
};

/** One picture, drawn several times. */
struct SurfacesRow {
    /** What is varied: subdivisions, size, order or elements. */
    std::string series;
    std::string surface;
    std::uint64_t n_elements = 0;
    std::uint32_t order = 0;
    std::uint32_t size = 0;
    std::uint32_t subdivisions = 0;
    Precision precision = Precision::float32;
    /** Least of the runs; see bench.hpp. */
    double milliseconds = 0;
    double wall_milliseconds = 0;
    /** Processor time over U. */
    double units = 0;
    std::uint64_t hit_pixels = 0;
    std::uint64_t contour_pixels = 0;
    std::uint64_t undecided_pixels = 0;
    RendererMemory memory;
    /** All that the program has on the device, pictures included. */
    std::uint64_t device_bytes = 0;
};

/** Calls `report` after each picture. */
std::vector<SurfacesRow> bench_surfaces(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                        const SurfacesOptions& options, double unit_nanoseconds,
                                        const std::function<void(const SurfacesRow&)>& report);

/** surfaces.csv and the plots, in a folder that is made if it does not exist. */
void write_surfaces(const std::filesystem::path& folder, const std::vector<SurfacesRow>& rows);

} // namespace elvis
