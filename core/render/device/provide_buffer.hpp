/**
 * @file provide_buffer.hpp
 * Buffers that are kept from frame to frame: fresh memory costs a page fault for each page.
 */
#pragma once

#include <core/vulkan/buffer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <optional>

namespace elvis {

/** Makes the buffer anew if it is of another size, the old one gone first; what it held is lost then. */
inline Buffer& provide_buffer(std::optional<Buffer>& buffer, const Device& device, std::uint64_t bytes) {
    if (!buffer || buffer->bytes() != bytes) {
        buffer.reset();
        buffer.emplace(device, bytes);
    }
    return *buffer;
}

} // namespace elvis
