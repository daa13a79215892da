/**
 * @file compute_device.hpp
 * Logical devices with one compute queue, and the features that kernels rely on.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>

namespace elvis {

/** The queue family with compute to use, preferring one without graphics (asynchronous compute); none: UINT32_MAX. */
std::uint32_t compute_queue_family(VkPhysicalDevice device);

struct ComputeDeviceOptions {
    /** Kernels ask for a size of their subgroups. */
    bool chooses_subgroup_size = false;
    std::span<const char* const> extensions{};
    /** Features of those, as a chain of Vulkan's; may be null. */
    void* features = nullptr;
};

/** The same features for drawing as for asking what a compiler makes of kernels. `place`: for messages. Throws Error. */
VkDevice create_compute_device(VkPhysicalDevice physical, const ComputeDeviceOptions& options, const std::string& place);

} // namespace elvis
