/**
 * @file surface_device.hpp
 * A Vulkan device that shows pictures in a window.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>

namespace elvis {
class Instance;
}

namespace elvis::view {

/** A window's surface and the device that draws there, with one queue. */
struct SurfaceDevice {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    VkQueue queue = VK_NULL_HANDLE;
    std::string name;
};

/** Of instances. An Error if this machine cannot show windows by Vulkan. */
std::span<const char* const> window_extensions();
/** The wanted one if it can present to the surface, else the first that can. */
void choose_device(SurfaceDevice& target, const Instance& instance, const std::string& wanted);
/** Of the physical device that was chosen. */
void create_device(SurfaceDevice& target);
/** Draws over what a transfer has put into an image, which can be presented then. */
VkRenderPass create_render_pass(const SurfaceDevice& target, VkFormat format);

} // namespace elvis::view
