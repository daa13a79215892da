/**
 * @file extrema_finder.hpp
 * Extrema of fields and expressions of a volume: from the plugin and on the CPU, or from samples on a device.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/volume_ranges.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>
#include <optional>

namespace elvis {

/** One thread at a time. */
class ExtremaFinder {
public:
    /** The volume, and the device that the function opens where a device alone can tell, must outlive it. */
    ExtremaFinder(const RuntimeVolume& volume, std::function<const Device&()> device)
        : m_volume(volume), m_device(std::move(device)) {}

    /** Throws Error where they cannot be found. */
    FieldExtrema of(const FieldChoice& field, std::uint32_t time_step);
    /** Values of fields have changed: what is known of them goes. */
    void forget_fields();

private:
    const RuntimeVolume& m_volume;
    std::function<const Device&()> m_device;
    std::optional<DeviceVolume> m_data;
    std::optional<VolumeRanges> m_ranges;
};

} // namespace elvis
