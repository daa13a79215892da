#include <core/vulkan/compute_device.hpp>

#include <core/vulkan/check.hpp>

#include <algorithm>
#include <vector>

namespace elvis {

std::uint32_t compute_queue_family(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    std::uint32_t found = UINT32_MAX;
    for (std::uint32_t family = 0; family < count; ++family) {
        const VkQueueFlags flags = families[family].queueFlags;
        if ((flags & VK_QUEUE_COMPUTE_BIT) == 0) {
            continue;
        }
        if ((flags & VK_QUEUE_GRAPHICS_BIT) == 0) {
            return family;
        }
        found = std::min(found, family);
    }
    return found;
}

VkDevice create_compute_device(VkPhysicalDevice physical, const ComputeDeviceOptions& options, const std::string& place) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue_info{};
    queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_info.queueFamilyIndex = compute_queue_family(physical);
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;

    VkPhysicalDeviceFeatures present{};
    vkGetPhysicalDeviceFeatures(physical, &present);
    VkPhysicalDeviceVulkan13Features v13{};
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    v13.pNext = options.features;
    v13.maintenance4 = VK_TRUE; // Every 1.3 driver has it; glslang writes work group sizes its way for SPIR-V 1.6.
    v13.subgroupSizeControl = options.chooses_subgroup_size ? VK_TRUE : VK_FALSE;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &v13;
    features.features.shaderFloat64 = present.shaderFloat64;
    features.features.shaderInt64 = present.shaderInt64;
    // A plugin's snippet that reads out of bounds must not take the device down.
    features.features.robustBufferAccess = VK_TRUE;

    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue_info;
    info.enabledExtensionCount = static_cast<std::uint32_t>(options.extensions.size());
    info.ppEnabledExtensionNames = options.extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    check_vulkan(vkCreateDevice(physical, &info, nullptr, &device), place, "creating the device");
    return device;
}

} // namespace elvis
