/**
 * @file combined.hpp
 * What a picture of everything takes beside pictures of its parts, and what passes share.
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/** One picture: a part, the sum of the parts, or all of them with what its name says. */
struct CombinedRow {
    std::string name;
    double milliseconds = 0;
    double wall_milliseconds = 0;
    FrameCounts counts;
    /** Of a picture of everything: its colours differ from those without any sharing by at most this. */
    double difference = 0;
};

/**
 * The boundary, transparent; a cut plane with contours and mesh lines; an isosurface; the volume itself. Of the volume, a
 * native one such as the canister, or of the waves if it is empty; the isovalue is at 0.6 of the field's range if there is
 * none. Calls `report` after each row.
 */
void bench_combined(const Device& device, const PluginRegistry& registry, const BenchFolder& folder, const std::string& volume,
                    std::optional<double> isovalue, std::uint32_t size, const std::function<void(const CombinedRow&)>& report);

} // namespace elvis
