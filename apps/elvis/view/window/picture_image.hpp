/**
 * @file picture_image.hpp
 * The picture as an image on the device that shows it.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <span>

namespace elvis::view {

/** In the target's format. Nothing of it may be in use by the device when it is written or goes. */
class PictureImage {
public:
    /** `format`: B8G8R8A8 or R8G8B8A8. */
    PictureImage(VkPhysicalDevice physical, VkDevice device, VkFormat format, std::uint32_t width, std::uint32_t height);
    ~PictureImage();
    PictureImage(const PictureImage&) = delete;
    PictureImage& operator=(const PictureImage&) = delete;

    std::uint32_t width() const { return m_width; }
    std::uint32_t height() const { return m_height; }

    void write(std::span<const std::uint8_t> rgba) const;
    /** From what was written, to where it can be read from. */
    void record_upload(VkCommandBuffer commands) const;
    /** To a box, stretched if need be, as far as that lies in the target, which is in the layout for transfers. */
    void record_copy(VkCommandBuffer commands, VkImage target, VkExtent2D target_size, std::array<int, 2> corner,
                     std::array<int, 2> size) const;

private:
    void release() noexcept;

    VkDevice m_device;
    VkFormat m_format;
    std::uint32_t m_width, m_height;
    VkBuffer m_buffer = VK_NULL_HANDLE;
    VkDeviceMemory m_buffer_memory = VK_NULL_HANDLE;
    void* m_mapped = nullptr;
    VkImage m_image = VK_NULL_HANDLE;
    VkDeviceMemory m_image_memory = VK_NULL_HANDLE;
};

} // namespace elvis::view
