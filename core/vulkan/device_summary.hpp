/**
 * @file device_summary.hpp
 * What is said of a physical device.
 */
#pragma once

#include <core/vulkan/device.hpp>

namespace elvis {

/** `index`: its place in Vulkan's order. */
DeviceSummary summarize(VkPhysicalDevice device, std::uint32_t index);

bool has_extension(VkPhysicalDevice device, const char* name);

} // namespace elvis
