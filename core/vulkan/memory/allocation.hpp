/**
 * @file allocation.hpp
 * A Vulkan buffer with its own memory, filled and read by the host.
 */
#pragma once

#include <core/vulkan/device.hpp>

#include <cstddef>
#include <functional>
#include <span>

namespace elvis {

/**
 * Device-local memory. Where that memory can also be mapped and cached by the host (CPU drivers, integrated GPUs), the host
 * writes to it directly; elsewhere it passes through the device's staging buffer, piece by piece.
 */
class Allocation {
public:
    /** The device must outlive it. `place` names the buffer in errors. */
    Allocation(const Device& device, std::uint64_t bytes, VkBufferUsageFlags usage, const char* place);
    ~Allocation();
    Allocation(Allocation&& other) noexcept;
    Allocation& operator=(Allocation&& other) noexcept;

    VkBuffer handle() const { return m_buffer; }
    std::uint64_t bytes() const { return m_bytes; }

    /** Produces the bytes `from ..` of a write, counted from the write's own start. */
    using Producer = std::function<void(std::uint64_t from, std::span<std::byte> destination)>;
    /**
     * Writes `bytes` bytes at `offset`. The producer is called for consecutive pieces whose lengths are multiples of
     * `granularity` bytes (the last ends the write), which must not exceed Device::Impl::staging_bytes.
     */
    void write(std::uint64_t offset, std::uint64_t bytes, std::uint64_t granularity, const Producer& produce) const;
    void read(std::uint64_t offset, std::span<std::byte> data) const;
    /** The beginnings of allocations of one device, with one wait for each Device::Impl::staging_bytes. */
    struct Read {
        const Allocation* from;
        std::span<std::byte> data;
    };
    static void read_together(std::span<const Read> reads);
    void fill(std::uint32_t word) const;

private:
    void release() noexcept;
    /** Among the commands that are pending, if it is small. */
    bool write_in_turn(std::uint64_t offset, std::uint64_t bytes, const Producer& produce) const;
    /** With one wait. */
    static void read_through_staging(std::span<const Read> reads);

    const Device* m_device = nullptr;
    std::uint64_t m_bytes = 0;
    std::uint64_t m_allocated = 0;
    VkBuffer m_buffer = VK_NULL_HANDLE;
    VkDeviceMemory m_memory = VK_NULL_HANDLE;
    std::byte* m_mapped = nullptr; ///< null where staging is needed
};

} // namespace elvis
