/**
 * @file goals.hpp
 * Two pictures of the canister (tests/data/elvis/bulletH1P2.dat) that a GPU should draw within a given time.
 */
#pragma once

#include <core/plugin_host/plugin.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace elvis {

struct GoalRow {
    /** cut plane or volume. */
    std::string name;
    std::uint32_t width = 0, height = 0;
    /** The least of some frames after the first: by the device's clock, if it has one; and until the picture is there. */
    std::optional<double> device_milliseconds;
    double wall_milliseconds = 0;
    /** What a frame's kernels take by the device's clock, and "copies"; the mean. */
    std::map<std::string, double> parts;
    /** Of the device, for pictures of full size. */
    double goal_milliseconds = 0;
    /** Pixels that something is seen in. */
    std::uint64_t covered_pixels = 0;
};

/**
 * Of `volume`, the converted canister: its plane x = 0 in 1800x800 pixels, and the volume itself, by the exact integrator, in
 * 1720x860. `width`, if not 0: of the plane's picture, in place of 1800; the volume's is smaller by as much. Calls `report`
 * after each.
 */
void bench_goals(const Device& device, const PluginRegistry& registry, const std::string& volume, std::uint32_t width,
                 const std::function<void(const GoalRow&)>& report);

} // namespace elvis
