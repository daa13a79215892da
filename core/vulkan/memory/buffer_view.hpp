/**
 * @file buffer_view.hpp
 * A buffer as texels.
 */
#pragma once

#include <core/vulkan/device.hpp>

namespace elvis {

/** All of a buffer, in whole texels. The device must outlive it. */
class BufferView {
public:
    BufferView(const Device& device, VkBuffer buffer, VkFormat format);
    ~BufferView();
    BufferView(const BufferView&) = delete;
    BufferView& operator=(const BufferView&) = delete;

    VkBufferView handle() const { return m_view; }

private:
    const Device& m_device;
    VkBufferView m_view = VK_NULL_HANDLE;
};

} // namespace elvis
