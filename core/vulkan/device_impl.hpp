/**
 * @file device_impl.hpp
 * What the files of core/vulkan share about a device.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/vulkan/command_queue.hpp>
#include <core/vulkan/device.hpp>
#include <core/vulkan/instance.hpp>
#include <core/vulkan/kernel/pipeline_pool.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace elvis {

/** The device's pipeline cache: read from disk when made, written back when it has grown. */
class PipelineCache {
public:
    PipelineCache(VkDevice device, const std::string& device_key);
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    VkPipelineCache handle() const { return m_cache; }

private:
    VkDevice m_device;
    std::string m_entry;
    std::size_t m_bytes_on_disk = 0;
    VkPipelineCache m_cache = VK_NULL_HANDLE;
};

/** A host-visible buffer through which data passes to and from memory that the host cannot map. */
struct Staging {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;
    /** So many bytes are on their way to the device, the last of them in this submission (CommandQueue::submission). */
    std::uint64_t used = 0, used_in = 0;
};

struct Device::Impl {
    /** Size of the staging buffer: large enough that submissions cost little, small against any data. */
    static constexpr std::uint64_t staging_bytes = 32u << 20u;

    explicit Impl(const DeviceOptions& options);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    DeviceOptions options;
    Instance instance;
    DeviceSummary summary;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    std::uint32_t subgroup_size = 0;
    /** For pipelines; 0: the driver's choice. */
    std::uint32_t required_subgroup_size = 0;
    std::uint64_t max_allocation_bytes = 0;
    bool texel_buffers = false;
    std::uint64_t max_binding_bytes = 0;
    std::string cache_key;

    VkDevice device = VK_NULL_HANDLE;
    std::unique_ptr<CommandQueue> queue;
    std::unique_ptr<PipelineCache> pipelines;
    PipelinePool kept_pipelines;
    Background background{std::max(1u, std::thread::hardware_concurrency())};
    std::atomic<std::uint64_t> allocated_bytes{0};
    /** memory_limit.hpp; no limit is 0. */
    std::atomic<std::uint64_t> most_bytes{0}, peak_bytes{0};
    /** Of main memory, all of the process; no limit is 0. */
    std::atomic<std::uint64_t> most_process_bytes{0};
    /** Kernels that are being made. */
    std::atomic<std::uint64_t> n_in_making{0};
    std::atomic<std::uint64_t> n_buffers{0}, n_kernels{0};

    /** Guards the staging buffer; taken before the queue's. */
    std::mutex staging_mutex;
    Staging staging;
    /** Guards the builds. */
    std::mutex builds_mutex;
    std::vector<KernelBuild> builds;
    /** Guards the tasks. */
    std::mutex tasks_mutex;
    /** By thread. */
    std::map<std::thread::id, const TaskControl*> tasks;

    /** "device 'NAME'", for errors. */
    std::string place() const { return "device '" + summary.name + "'"; }
    /** Index of the first type among `type_bits` with these properties; none: UINT32_MAX. */
    std::uint32_t memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags properties) const;
    /** Needs staging_mutex. Makes the staging buffer when it is first needed. */
    Staging& use_staging();
    /** Of this thread; null if there is none. */
    const TaskControl* task();
    void set_task(const TaskControl* control);

private:
    void create_device();
    void release() noexcept;
};

} // namespace elvis
