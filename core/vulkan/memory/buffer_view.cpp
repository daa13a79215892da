#include <core/vulkan/memory/buffer_view.hpp>

#include <core/vulkan/check.hpp>
#include <core/vulkan/device_impl.hpp>

namespace elvis {

BufferView::BufferView(const Device& device, VkBuffer buffer, VkFormat format) : m_device(device) {
    VkBufferViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    info.buffer = buffer;
    info.format = format;
    info.range = VK_WHOLE_SIZE;
    check_vulkan(vkCreateBufferView(device.handle(), &info, nullptr, &m_view), device.impl().place(), "creating a buffer view");
}

BufferView::~BufferView() {
    m_device.impl().queue->when_done(
        [device = m_device.handle(), view = m_view] { vkDestroyBufferView(device, view, nullptr); });
}

} // namespace elvis
