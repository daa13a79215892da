/**
 * @file volume.hpp
 * What pictures of the volume itself take, on the waves volumes.
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace elvis {

/** Of density and colour for a field between -1.5 and 1.5. */
enum class BenchTransfer {
    prototype, ///< two smooth bumps over haze, as a table: 3 exp(-8 (f - 1)^2) + 3 exp(-8 (f + 1)^2) + 0.3
    peaks,     ///< three triangles, each 1 % of the range wide, nothing between
    ramp       ///< linear
};
const char* name_of(BenchTransfer transfer);
TransferFunction bench_transfer(BenchTransfer transfer);

const char* name_of(Integrator integrator);
/** Throws an Error that names what there is. */
Integrator integrator_of(const std::string& name);

/** The waves picture of the volume alone. Steps, where the integrator takes them, are about 256 a ray. */
FrameRequest waves_volume_picture(std::uint32_t size, BenchTransfer transfer, Integrator integrator);

struct VolumeResult {
    BenchTransfer transfer = BenchTransfer::prototype;
    Integrator integrator = Integrator::exact;
    std::uint32_t elements_a_side = 0;
    std::uint32_t order = 0;
    std::uint32_t size = 0;
    double milliseconds = 0;
    double wall_milliseconds = 0;
    /** Of pixels whose rays meet the volume. */
    double evaluations_a_pixel = 0, mappings_a_pixel = 0, segments_a_pixel = 0, empty_segments_a_pixel = 0, steps_a_pixel = 0,
           breakpoints_a_pixel = 0, inexact_share = 0;
};
/** Calls `report` after each picture. */
void bench_volume(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                  const std::vector<Integrator>& integrators, const std::vector<std::uint32_t>& elements_a_side,
                  const std::vector<std::uint32_t>& orders, const std::vector<std::uint32_t>& sizes,
                  const std::function<void(const VolumeResult&)>& report);

} // namespace elvis
