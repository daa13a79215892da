#include <core/vulkan/check.hpp>

#include <core/base/error.hpp>

namespace elvis {

std::string vulkan_result_text(VkResult result) {
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "out of device memory";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "the driver could not be initialized";
    case VK_ERROR_DEVICE_LOST:
        return "the device was lost: its driver was reset, or a kernel ran longer than the system allows";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "a layer is not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "the driver lacks an extension";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "the driver lacks a feature";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "no Vulkan driver fits";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "too many objects (allocations) exist";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        return "out of descriptors";
    default:
        return "Vulkan error " + std::to_string(static_cast<int>(result));
    }
}

void check_vulkan(VkResult result, const std::string& place, const char* activity) {
    if (result != VK_SUCCESS) {
        throw Error(place, std::string(activity) + " failed: " + vulkan_result_text(result));
    }
}

} // namespace elvis
