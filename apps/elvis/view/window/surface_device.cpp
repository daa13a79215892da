#include "surface_device.hpp"

#include "error_place.hpp"

#include <core/base/error.hpp>
#include <core/vulkan/check.hpp>
#include <core/vulkan/device_choice.hpp>
#include <core/vulkan/device_summary.hpp>
#include <core/vulkan/instance.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <spdlog/spdlog.h>

#include <optional>
#include <vector>

namespace elvis::view {

namespace {

/** A family with graphics that can present to the surface, if the device has one. */
std::optional<std::uint32_t> queue_family(VkPhysicalDevice device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t family = 0; family < count; ++family) {
        VkBool32 presents = VK_FALSE;
        if (vkGetPhysicalDeviceSurfaceSupportKHR(device, family, surface, &presents) == VK_SUCCESS && presents == VK_TRUE &&
            (families[family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) {
            return family;
        }
    }
    return std::nullopt;
}

} // namespace

std::span<const char* const> window_extensions() {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) {
        throw Error(error_place, "this machine has no Vulkan driver that can show pictures in windows (Debian package "
                                 "mesa-vulkan-drivers has one for the CPU)");
    }
    return {names, count};
}

void choose_device(SurfaceDevice& target, const Instance& instance, const std::string& wanted) {
    const std::vector<DeviceSummary> summaries = instance.summaries();
    const std::vector<VkPhysicalDevice> devices = instance.physical_devices();
    std::vector<DeviceSummary> able;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (!summaries[i].only_compiles && has_extension(devices[i], VK_KHR_SWAPCHAIN_EXTENSION_NAME) &&
            queue_family(devices[i], target.surface)) {
            able.push_back(summaries[i]);
        }
    }
    if (able.empty()) {
        throw Error(error_place, "no Vulkan device of this machine can show pictures in it");
    }
    DeviceSummary chosen = able.front();
    try {
        chosen = choose_among(able, wanted);
    } catch (const Error& error) {
        spdlog::info("window: {}; it is shown by {}", error.what(), chosen.name);
    }
    target.physical = devices[chosen.index];
    target.name = chosen.name;
    target.family = *queue_family(target.physical, target.surface);
}

void create_device(SurfaceDevice& target) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue_info{};
    queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_info.queueFamilyIndex = target.family;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    const char* extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue_info;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    check_vulkan(vkCreateDevice(target.physical, &info, nullptr, &target.device), error_place, "creating its device");
    vkGetDeviceQueue(target.device, target.family, 0, &target.queue);
}

VkRenderPass create_render_pass(const SurfaceDevice& target, VkFormat format) {
    VkAttachmentDescription attachment{};
    attachment.format = format;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD; // The picture is there already.
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkSubpassDependency before{};
    before.srcSubpass = VK_SUBPASS_EXTERNAL;
    before.srcStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
    before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    before.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    before.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &before;
    VkRenderPass render_pass = VK_NULL_HANDLE;
    check_vulkan(vkCreateRenderPass(target.device, &info, nullptr, &render_pass), error_place, "creating its render pass");
    return render_pass;
}

} // namespace elvis::view
