#include <core/vulkan/subgroup_choice.hpp>

namespace elvis {

SubgroupChoice choose_subgroup(VkPhysicalDevice device) {
    VkPhysicalDeviceVulkan11Properties v11{};
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &v11;
    vkGetPhysicalDeviceProperties2(device, &properties);
    return {.size = v11.subgroupSize, .required = 0};
}

} // namespace elvis
