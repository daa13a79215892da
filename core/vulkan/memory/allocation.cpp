#include <core/vulkan/memory/allocation.hpp>

#include <core/base/error.hpp>
#include <core/base/memory.hpp>
#include <core/vulkan/check.hpp>
#include <core/vulkan/device_impl.hpp>
#include <core/vulkan/memory/memory_limit.hpp>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace elvis {

namespace {

std::string mebibytes(std::uint64_t bytes) { return std::to_string((bytes + (1u << 20u) - 1) >> 20u) + " MiB"; }

OutOfMemory too_large(const Device::Impl& device, std::uint64_t bytes, const char* place, const std::string& reason) {
    return OutOfMemory(device.place(), std::string("no memory for ") + place + " of " + mebibytes(bytes) + ": " + reason +
                                           " (" + mebibytes(device.allocated_bytes) + " are in use)");
}

void raise(std::atomic<std::uint64_t>& most, std::uint64_t bytes) {
    std::uint64_t known = most;
    while (known < bytes && !most.compare_exchange_weak(known, bytes)) {
    }
}

/** Below this, asking how much memory there is takes longer than it is worth. */
constexpr std::uint64_t large_bytes = 64u << 20u;
/** Smaller ones are not looked at where the process has a limit. */
constexpr std::uint64_t noticed_bytes = 1u << 20u;
/** What making a kernel takes at most, compiler and driver: 70 MiB were measured, of isosurfaces on a software device. */
constexpr std::uint64_t kernel_bytes = 96u << 20u;

} // namespace

Allocation::Allocation(const Device& device, std::uint64_t bytes, VkBufferUsageFlags usage, const char* place)
    : m_device(&device), m_bytes(bytes) {
    Device::Impl& impl = device.impl();
    if (bytes > impl.max_allocation_bytes) {
        throw too_large(impl, bytes, place,
                        "the device allocates at most " + mebibytes(impl.max_allocation_bytes) + " at once");
    }
    // A driver for CPUs promises any amount, and the system ends the process once that is used.
    if (impl.summary.type == "cpu" && bytes >= large_bytes && bytes > available_bytes()) {
        throw too_large(impl, bytes, place, "the machine has " + mebibytes(available_bytes()) + " left");
    }
    if (impl.most_process_bytes != 0 && impl.summary.type == "cpu" && bytes >= noticed_bytes &&
        resident_bytes() + bytes > impl.most_process_bytes) {
        throw too_large(impl, bytes, place, "the process may hold " + mebibytes(impl.most_process_bytes));
    }
    if (impl.most_bytes != 0 && impl.allocated_bytes + bytes > impl.most_bytes) {
        throw too_large(impl, bytes, place, "the budget for its memory is " + mebibytes(impl.most_bytes));
    }
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    // Vulkan knows no empty buffers, and views end with a whole texel.
    constexpr std::uint64_t texel_bytes = 16;
    info.size = std::max((bytes + texel_bytes - 1) / texel_bytes, std::uint64_t{1}) * texel_bytes;
    info.usage =
        usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    check_vulkan(vkCreateBuffer(impl.device, &info, nullptr, &m_buffer), impl.place(), "creating a buffer");
    ++impl.n_buffers;
    try {
        VkMemoryRequirements needs{};
        vkGetBufferMemoryRequirements(impl.device, m_buffer, &needs);
        constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        constexpr VkMemoryPropertyFlags mappable =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
        std::uint32_t type = impl.options.always_stage ? UINT32_MAX : impl.memory_type(needs.memoryTypeBits, local | mappable);
        const bool map = type != UINT32_MAX;
        if (!map) {
            type = impl.memory_type(needs.memoryTypeBits, local);
        }
        if (type == UINT32_MAX) {
            type = impl.memory_type(needs.memoryTypeBits, 0);
        }
        VkMemoryAllocateInfo allocate{};
        allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
        allocate.allocationSize = needs.size;
        allocate.memoryTypeIndex = type;
        const VkResult result = vkAllocateMemory(impl.device, &allocate, nullptr, &m_memory);
        if (result != VK_SUCCESS) {
            m_memory = VK_NULL_HANDLE;
            throw too_large(impl, bytes, place, vulkan_result_text(result));
        }
        m_allocated = needs.size;
        raise(impl.peak_bytes, impl.allocated_bytes += m_allocated);
        check_vulkan(vkBindBufferMemory(impl.device, m_buffer, m_memory, 0), impl.place(), "binding a buffer");
        if (map) {
            void* mapped = nullptr;
            check_vulkan(vkMapMemory(impl.device, m_memory, 0, VK_WHOLE_SIZE, 0, &mapped), impl.place(), "mapping a buffer");
            m_mapped = static_cast<std::byte*>(mapped);
        }
        if (impl.options.validation) {
            fill(0xffffffffu); // NaN: nobody shall rely on memory that was never written.
        }
    } catch (...) {
        release();
        throw;
    }
}

void Allocation::release() noexcept {
    if (m_buffer != VK_NULL_HANDLE) {
        Device::Impl& impl = m_device->impl();
        impl.queue->when_done([device = impl.device, buffer = m_buffer, memory = m_memory] {
            vkDestroyBuffer(device, buffer, nullptr);
            vkFreeMemory(device, memory, nullptr); // Also unmaps.
        });
        impl.allocated_bytes -= m_allocated;
        --impl.n_buffers;
    }
    m_buffer = VK_NULL_HANDLE;
    m_memory = VK_NULL_HANDLE;
    m_mapped = nullptr;
    m_allocated = 0;
}

Allocation::~Allocation() { release(); }

Allocation::Allocation(Allocation&& other) noexcept { *this = std::move(other); }

Allocation& Allocation::operator=(Allocation&& other) noexcept {
    if (this != &other) {
        release();
        m_device = other.m_device;
        m_bytes = other.m_bytes;
        m_allocated = std::exchange(other.m_allocated, 0);
        m_buffer = std::exchange(other.m_buffer, VK_NULL_HANDLE);
        m_memory = std::exchange(other.m_memory, VK_NULL_HANDLE);
        m_mapped = std::exchange(other.m_mapped, nullptr);
    }
    return *this;
}

void Allocation::write(std::uint64_t offset, std::uint64_t bytes, std::uint64_t granularity, const Producer& produce) const {
    assert(offset + bytes <= m_bytes && granularity > 0);
    if (bytes == 0) {
        return;
    }
    Device::Impl& impl = m_device->impl();
    // What is mapped is written at once, unless commands that are pending read what is there.
    const bool waits = m_mapped != nullptr ? !impl.queue->is_pending() : !impl.queue->collects();
    if (!waits && write_in_turn(offset, bytes, produce)) {
        return;
    }
    if (m_mapped != nullptr) {
        impl.queue->finish(); // It may read what is replaced.
        produce(0, {m_mapped + offset, static_cast<std::size_t>(bytes)});
        return;
    }
    const std::lock_guard lock(impl.staging_mutex);
    Staging& staging = impl.use_staging();
    for (std::uint64_t done = 0; done < bytes;) {
        if (impl.queue->is_done(staging.used_in)) {
            staging.used = 0;
        }
        const std::uint64_t room = (Device::Impl::staging_bytes - staging.used) / granularity * granularity;
        // What is on its way stays where it is until there is no room beside it.
        if (room < std::min(bytes - done, std::max(granularity, Device::Impl::staging_bytes / 4)) && staging.used > 0) {
            impl.queue->finish();
            staging.used = 0;
            continue;
        }
        assert(room > 0);
        const VkBufferCopy region{staging.used, offset + done, std::min(room, bytes - done)};
        produce(done, {staging.mapped + region.srcOffset, static_cast<std::size_t>(region.size)});
        impl.queue->record(CommandQueue::copies, [&](VkCommandBuffer commands) {
            vkCmdCopyBuffer(commands, staging.buffer, m_buffer, 1, &region);
            staging.used_in = impl.queue->submission();
        });
        done += region.size;
        constexpr std::uint64_t alignment = 16; // Of all numbers that are produced.
        staging.used += (region.size + alignment - 1) / alignment * alignment;
    }
}

bool Allocation::write_in_turn(std::uint64_t offset, std::uint64_t bytes, const Producer& produce) const {
    constexpr std::uint64_t most = 65536; // Of vkCmdUpdateBuffer, as that all are multiples of 4.
    if (bytes > most || offset % 4 != 0 || bytes % 4 != 0) {
        return false;
    }
    std::vector<std::byte> data(static_cast<std::size_t>(bytes));
    produce(0, data);
    m_device->record([&](VkCommandBuffer commands) { vkCmdUpdateBuffer(commands, m_buffer, offset, bytes, data.data()); });
    return true;
}

void Allocation::read(std::uint64_t offset, std::span<std::byte> data) const {
    assert(offset + data.size() <= m_bytes);
    if (data.empty()) {
        return;
    }
    Device::Impl& impl = m_device->impl();
    if (m_mapped != nullptr) {
        impl.queue->finish();
        std::memcpy(data.data(), m_mapped + offset, data.size());
        return;
    }
    const std::lock_guard lock(impl.staging_mutex);
    const Staging& staging = impl.use_staging();
    for (std::uint64_t done = 0; done < data.size(); done += Device::Impl::staging_bytes) {
        const VkBufferCopy region{offset + done, 0, std::min<std::uint64_t>(Device::Impl::staging_bytes, data.size() - done)};
        impl.queue->record(CommandQueue::copies,
                           [&](VkCommandBuffer commands) { vkCmdCopyBuffer(commands, m_buffer, staging.buffer, 1, &region); });
        impl.queue->finish();
        std::memcpy(data.data() + done, staging.mapped, static_cast<std::size_t>(region.size));
    }
}

void Allocation::read_together(std::span<const Read> reads) {
    while (!reads.empty()) {
        std::uint64_t bytes = 0;
        std::size_t n = 0;
        while (n < reads.size() && bytes + reads[n].data.size() <= Device::Impl::staging_bytes) {
            bytes += reads[n++].data.size();
        }
        if (n < 2 || reads.front().from->m_mapped != nullptr) {
            reads.front().from->read(0, reads.front().data);
            reads = reads.subspan(1);
        } else {
            read_through_staging(reads.first(n));
            reads = reads.subspan(n);
        }
    }
}

void Allocation::read_through_staging(std::span<const Read> reads) {
    Device::Impl& impl = reads.front().from->m_device->impl();
    const std::lock_guard lock(impl.staging_mutex);
    const Staging& staging = impl.use_staging();
    VkBufferCopy region{};
    for (const Read& read : reads) {
        region.size = read.data.size();
        if (region.size == 0) {
            continue;
        }
        impl.queue->record(CommandQueue::copies, [&](VkCommandBuffer commands) {
            vkCmdCopyBuffer(commands, read.from->m_buffer, staging.buffer, 1, &region);
        });
        region.dstOffset += region.size;
    }
    impl.queue->finish();
    const std::byte* at = staging.mapped;
    for (const Read& read : reads) {
        std::memcpy(read.data.data(), at, read.data.size());
        at += read.data.size();
    }
}

void Allocation::fill(std::uint32_t word) const {
    m_device->record([&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, m_buffer, 0, VK_WHOLE_SIZE, word); });
}

void limit_memory(const Device& device, std::uint64_t bytes) {
    Device::Impl& impl = device.impl();
    impl.most_bytes = bytes;
    impl.peak_bytes = impl.allocated_bytes.load();
}

std::uint64_t peak_allocated_bytes(const Device& device) { return device.impl().peak_bytes; }

void limit_process_memory(const Device& device, std::uint64_t bytes) { device.impl().most_process_bytes = bytes; }

std::shared_ptr<void> need_kernel_room(const Device& device, const std::string& kernel) {
    Device::Impl& impl = device.impl();
    const std::uint64_t most = impl.most_process_bytes;
    const auto is_room = [&] { return most == 0 || resident_bytes() + (impl.n_in_making + 1) * kernel_bytes <= most; };
    if (!is_room()) {
        impl.background.finish();
        give_back_free_memory(); // The compilers'.
    }
    if (!is_room()) {
        throw OutOfMemory("kernel '" + kernel + "' on " + impl.place(),
                          "the process holds " + mebibytes(resident_bytes()) + " of the " + mebibytes(most) + " that it may");
    }
    ++impl.n_in_making;
    return {&impl, [](Device::Impl* on) { --on->n_in_making; }};
}

void forget_pipelines(const Device& device) {
    Device::Impl& impl = device.impl();
    impl.kept_pipelines.clear();
    // lavapipe keeps what is destroyed until work is submitted.
    impl.queue->record(CommandQueue::copies, [](VkCommandBuffer) {});
    impl.queue->finish();
}

} // namespace elvis
