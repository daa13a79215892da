/**
 * @file swapchain.hpp
 * The images that a window shows in turn.
 */
#pragma once

#include "surface_device.hpp"

#include <cstdint>
#include <vector>

namespace elvis::view {

/** A format whose numbers are shown as they are (no sRGB conversion). An Error if the surface has none. */
VkSurfaceFormatKHR display_format(VkPhysicalDevice device, VkSurfaceKHR surface);

class Swapchain {
public:
    /** Images of at most that size; `render_pass` is for their framebuffers. `old` may be given up for the new one. */
    Swapchain(const SurfaceDevice& device, VkSurfaceFormatKHR format, VkRenderPass render_pass, VkExtent2D size,
              const Swapchain* old);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    struct Image {
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        /** Signalled when it has been drawn. Of its own, as presentation may still wait for that of another one. */
        VkSemaphore drawn = VK_NULL_HANDLE;
    };

    VkSwapchainKHR handle() const { return m_swapchain; }
    VkExtent2D size() const { return m_size; }
    const std::vector<Image>& images() const { return m_images; }
    std::uint32_t least_images() const { return m_least_images; }

private:
    void add_image(VkImage handle, VkFormat format, VkRenderPass render_pass);
    void release() noexcept;

    VkDevice m_device;
    VkSwapchainKHR m_swapchain = VK_NULL_HANDLE;
    VkExtent2D m_size{};
    std::uint32_t m_least_images = 2;
    std::vector<Image> m_images;
};

} // namespace elvis::view
