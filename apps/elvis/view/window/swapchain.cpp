#include "swapchain.hpp"

#include "error_place.hpp"

#include <core/base/error.hpp>
#include <core/vulkan/check.hpp>

#include <algorithm>

namespace elvis::view {

VkSurfaceFormatKHR display_format(VkPhysicalDevice device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    check_vulkan(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr), error_place, "listing its formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    check_vulkan(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, formats.data()), error_place,
                 "listing its formats");
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
        for (const VkSurfaceFormatKHR& format : formats) {
            if (format.format == wanted) {
                return format;
            }
        }
    }
    throw Error(error_place, "its device offers no format with 8 bits a channel and plain numbers");
}

Swapchain::Swapchain(const SurfaceDevice& device, VkSurfaceFormatKHR format, VkRenderPass render_pass, VkExtent2D size,
                     const Swapchain* old)
    : m_device(device.device) {
    VkSurfaceCapabilitiesKHR capabilities{};
    check_vulkan(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical, device.surface, &capabilities), error_place,
                 "asking for its size");
    m_size = capabilities.currentExtent.width != UINT32_MAX ? capabilities.currentExtent : size;
    m_size.width = std::clamp(m_size.width, capabilities.minImageExtent.width, std::max(capabilities.maxImageExtent.width, 1u));
    m_size.height =
        std::clamp(m_size.height, capabilities.minImageExtent.height, std::max(capabilities.maxImageExtent.height, 1u));
    m_least_images = std::max(2u, capabilities.minImageCount);

    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = device.surface;
    info.minImageCount = m_least_images;
    info.imageFormat = format.format;
    info.imageColorSpace = format.colorSpace;
    info.imageExtent = m_size;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha = (capabilities.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR; // The one that is always there.
    info.clipped = VK_TRUE;
    info.oldSwapchain = old != nullptr ? old->handle() : VK_NULL_HANDLE;
    check_vulkan(vkCreateSwapchainKHR(m_device, &info, nullptr, &m_swapchain), error_place, "creating its images");
    try {
        std::uint32_t count = 0;
        check_vulkan(vkGetSwapchainImagesKHR(m_device, m_swapchain, &count, nullptr), error_place, "listing its images");
        std::vector<VkImage> images(count);
        check_vulkan(vkGetSwapchainImagesKHR(m_device, m_swapchain, &count, images.data()), error_place, "listing its images");
        for (const VkImage handle : images) {
            add_image(handle, format.format, render_pass);
        }
    } catch (...) {
        release();
        throw;
    }
}

void Swapchain::add_image(VkImage handle, VkFormat format, VkRenderPass render_pass) {
    Image& image = m_images.emplace_back();
    image.image = handle;
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = handle;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    check_vulkan(vkCreateImageView(m_device, &view, nullptr, &image.view), error_place, "creating a view");
    VkFramebufferCreateInfo framebuffer{};
    framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    framebuffer.renderPass = render_pass;
    framebuffer.attachmentCount = 1;
    framebuffer.pAttachments = &image.view;
    framebuffer.width = m_size.width;
    framebuffer.height = m_size.height;
    framebuffer.layers = 1;
    check_vulkan(vkCreateFramebuffer(m_device, &framebuffer, nullptr, &image.framebuffer), error_place,
                 "creating a framebuffer");
    VkSemaphoreCreateInfo semaphore{};
    semaphore.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    check_vulkan(vkCreateSemaphore(m_device, &semaphore, nullptr, &image.drawn), error_place, "creating a semaphore");
}

void Swapchain::release() noexcept {
    for (const Image& image : m_images) {
        vkDestroySemaphore(m_device, image.drawn, nullptr);
        vkDestroyFramebuffer(m_device, image.framebuffer, nullptr);
        vkDestroyImageView(m_device, image.view, nullptr);
    }
    vkDestroySwapchainKHR(m_device, m_swapchain, nullptr);
}

Swapchain::~Swapchain() { release(); }

} // namespace elvis::view
