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

/**
 * The devices of a list, by index: names as for choose_device, separated by ',', or "all": those of the best device's type,
 * since others would hold it up. A device may be named twice, and is then opened twice. Names with a ',' in them have to be
 * told by index or id.
 */
std::vector<std::string> named_devices(const std::string& list);

} // namespace elvis
