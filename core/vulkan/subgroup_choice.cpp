#include <core/vulkan/subgroup_choice.hpp>

namespace elvis {

SubgroupChoice choose_subgroup(VkPhysicalDevice device) {
    VkPhysicalDeviceSubgroupSizeControlProperties control{};
    control.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES;
    VkPhysicalDeviceVulkan11Properties v11{};
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    v11.pNext = &control;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &v11;
    vkGetPhysicalDeviceProperties2(device, &properties);
    VkPhysicalDeviceSubgroupSizeControlFeatures present{};
    present.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &present;
    vkGetPhysicalDeviceFeatures2(device, &features);

    constexpr std::uint32_t wanted = 32;
    const bool can_choose = present.subgroupSizeControl == VK_TRUE &&
                            (control.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 &&
                            control.minSubgroupSize <= wanted && wanted <= control.maxSubgroupSize;
    if (v11.subgroupSize > wanted && can_choose) {
        return {.size = wanted, .required = wanted};
    }
    return {.size = v11.subgroupSize, .required = 0};
}

} // namespace elvis
