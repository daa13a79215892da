/**
 * @file kernels.hpp
 * What a device's compiler makes of the kernels of four pictures, whether the device is there or its driver alone.
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/vulkan/kernel/kernel_inspector.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace elvis {

struct KernelRow {
    /** Path below shaders/. */
    std::string kernel;
    /** Of the elements, or the name of the volume. */
    std::string shape;
    Precision precision = Precision::float32;
    /** Of the time that all kernels take to draw the four pictures, where they were drawn. */
    double share = 0;
    /** Those that take nine tenths of the time of one of the pictures. */
    bool is_hot = false;
    /** Of SPIR-V. */
    std::uint64_t spirv_bytes = 0;
    KernelStatistics statistics;
};

struct KernelsOptions {
    /** Native volumes; none: bent elements of geometry order 3 with a field of order 5, a volume of each of `shapes`. */
    std::vector<std::string> volumes;
    std::vector<std::string> shapes{"hexahedron", "prism", "pyramid", "tetrahedron"};
    std::vector<Precision> precisions{Precision::float32, Precision::float64};
    /** Side of the pictures. */
    std::uint32_t size = 128;
};

/**
 * Draws the four pictures (four_pictures.hpp) on a device that can, with kernels as `inspector`'s device wants them, and asks
 * that device's compiler about each. Calls `report` after each kernel: for each shape and precision, those that took longest
 * to run come first.
 */
void bench_kernels(const KernelInspector& inspector, const PluginRegistry& registry, const BenchFolder& folder,
                   const KernelsOptions& options, const std::function<void(const KernelRow&)>& report);

} // namespace elvis
