/**
 * @file device_choice.hpp
 * Which of a machine's devices is meant.
 */
#pragma once

#include <core/vulkan/device.hpp>

namespace elvis {

/** Compiling takes a driver alone, drawing needs memory, too. */
enum class DeviceUse { drawing, compiling };

/** choose_device among these. */
DeviceSummary choose_among(const std::vector<DeviceSummary>& devices, const std::string& wanted,
                           DeviceUse use = DeviceUse::drawing);

} // namespace elvis
