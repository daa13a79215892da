#include "picture_image.hpp"

#include "error_place.hpp"

#include <core/base/error.hpp>
#include <core/vulkan/check.hpp>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace elvis::view {

namespace {

VkDeviceMemory allocate(VkPhysicalDevice physical, VkDevice device, const VkMemoryRequirements& needs,
                        VkMemoryPropertyFlags properties) {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        if ((needs.memoryTypeBits >> type & 1u) != 0 && (memory.memoryTypes[type].propertyFlags & properties) == properties) {
            VkMemoryAllocateInfo info{};
            info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
            info.allocationSize = needs.size;
            info.memoryTypeIndex = type;
            VkDeviceMemory result = VK_NULL_HANDLE;
            check_vulkan(vkAllocateMemory(device, &info, nullptr, &result), error_place, "allocating the picture");
            return result;
        }
    }
    throw Error(error_place, "its device has no memory for the picture");
}

void transition(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to, VkAccessFlags source,
                VkAccessFlags destination) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcAccessMask = source;
    barrier.dstAccessMask = destination;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1,
                         &barrier);
}

} // namespace

PictureImage::PictureImage(VkPhysicalDevice physical, VkDevice device, VkFormat format, std::uint32_t width,
                           std::uint32_t height)
    : m_device(device), m_format(format), m_width(width), m_height(height) {
    try {
        VkBufferCreateInfo buffer{};
        buffer.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
        buffer.size = VkDeviceSize{4} * width * height;
        buffer.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
        check_vulkan(vkCreateBuffer(device, &buffer, nullptr, &m_buffer), error_place, "making room for the picture");
        VkMemoryRequirements needs{};
        vkGetBufferMemoryRequirements(device, m_buffer, &needs);
        m_buffer_memory =
            allocate(physical, device, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
        check_vulkan(vkBindBufferMemory(device, m_buffer, m_buffer_memory, 0), error_place, "making room for the picture");
        check_vulkan(vkMapMemory(device, m_buffer_memory, 0, VK_WHOLE_SIZE, 0, &m_mapped), error_place, "mapping the picture");

        VkImageCreateInfo image{};
        image.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        image.imageType = VK_IMAGE_TYPE_2D;
        image.format = format;
        image.extent = {width, height, 1};
        image.mipLevels = 1;
        image.arrayLayers = 1;
        image.samples = VK_SAMPLE_COUNT_1_BIT;
        image.tiling = VK_IMAGE_TILING_OPTIMAL;
        image.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        image.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        check_vulkan(vkCreateImage(device, &image, nullptr, &m_image), error_place, "making room for the picture");
        vkGetImageMemoryRequirements(device, m_image, &needs);
        m_image_memory = allocate(physical, device, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        check_vulkan(vkBindImageMemory(device, m_image, m_image_memory, 0), error_place, "making room for the picture");
    } catch (...) {
        release();
        throw;
    }
}

PictureImage::~PictureImage() { release(); }

void PictureImage::release() noexcept {
    vkDestroyImage(m_device, m_image, nullptr);
    vkFreeMemory(m_device, m_image_memory, nullptr);
    vkDestroyBuffer(m_device, m_buffer, nullptr);
    vkFreeMemory(m_device, m_buffer_memory, nullptr);
}

void PictureImage::write(std::span<const std::uint8_t> rgba) const {
    assert(rgba.size() == std::size_t{4} * m_width * m_height);
    if (m_format == VK_FORMAT_R8G8B8A8_UNORM) {
        std::memcpy(m_mapped, rgba.data(), rgba.size());
        return;
    }
    auto* bytes = static_cast<std::uint8_t*>(m_mapped);
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const std::array<std::uint8_t, 4> bgra{rgba[i + 2], rgba[i + 1], rgba[i], rgba[i + 3]};
        std::memcpy(bytes + i, bgra.data(), bgra.size());
    }
}

void PictureImage::record_upload(VkCommandBuffer commands) const {
    transition(commands, m_image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_ACCESS_TRANSFER_READ_BIT,
               VK_ACCESS_TRANSFER_WRITE_BIT);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {m_width, m_height, 1};
    vkCmdCopyBufferToImage(commands, m_buffer, m_image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    transition(commands, m_image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT);
}

void PictureImage::record_copy(VkCommandBuffer commands, VkImage target, VkExtent2D target_size, std::array<int, 2> corner,
                               std::array<int, 2> size) const {
    const std::array<int, 2> limit{static_cast<int>(target_size.width), static_cast<int>(target_size.height)};
    const std::array<int, 2> source{static_cast<int>(m_width), static_cast<int>(m_height)};
    const bool is_scaled = size[0] != source[0] || size[1] != source[1];
    std::array<std::array<int, 2>, 2> from{}, to{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        if (size[axis] <= 0) {
            return;
        }
        to[0][axis] = std::clamp(corner[axis], 0, limit[axis]);
        to[1][axis] = std::clamp(corner[axis] + size[axis], 0, limit[axis]);
        from[0][axis] = (to[0][axis] - corner[axis]) * source[axis] / size[axis];
        from[1][axis] = (to[1][axis] - corner[axis]) * source[axis] / size[axis];
        if (to[0][axis] >= to[1][axis] || from[0][axis] >= from[1][axis]) {
            return;
        }
    }
    constexpr VkImageSubresourceLayers layer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    if (!is_scaled) {
        // Where the device is the CPU, this takes a fraction of the time of a blit.
        VkImageCopy copy{};
        copy.srcSubresource = copy.dstSubresource = layer;
        copy.srcOffset = {from[0][0], from[0][1], 0};
        copy.dstOffset = {to[0][0], to[0][1], 0};
        copy.extent = {static_cast<std::uint32_t>(to[1][0] - to[0][0]), static_cast<std::uint32_t>(to[1][1] - to[0][1]), 1};
        vkCmdCopyImage(commands, m_image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                       &copy);
        return;
    }
    VkImageBlit blit{};
    blit.srcSubresource = blit.dstSubresource = layer;
    blit.srcOffsets[1].z = blit.dstOffsets[1].z = 1;
    for (std::size_t end = 0; end < 2; ++end) {
        blit.srcOffsets[end].x = from[end][0];
        blit.srcOffsets[end].y = from[end][1];
        blit.dstOffsets[end].x = to[end][0];
        blit.dstOffsets[end].y = to[end][1];
    }
    vkCmdBlitImage(commands, m_image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                   &blit, VK_FILTER_LINEAR);
}

} // namespace elvis::view
