#include <core/base/error.hpp>
#include <core/base/host.hpp>
#include <core/base/log.hpp>
#include <core/vulkan/check.hpp>
#include <core/vulkan/compute_device.hpp>
#include <core/vulkan/device_choice.hpp>
#include <core/vulkan/device_impl.hpp>
#include <core/vulkan/device_summary.hpp>
#include <core/vulkan/subgroup_choice.hpp>

#include <algorithm>
#include <charconv>

namespace elvis {

namespace {

std::string variable(const char* name) { return environment_variable(name).value_or(""); }

bool flag_variable(const char* name) {
    const std::string value = variable(name);
    if (value.empty() || value == "0") {
        return false;
    }
    if (value == "1") {
        return true;
    }
    throw Error("$" + std::string(name), "'" + value + "' is neither 0 nor 1");
}

} // namespace

DeviceOptions DeviceOptions::from_environment(std::string wanted) {
    DeviceOptions options;
    options.wanted = std::move(wanted);
    options.validation = flag_variable("ELVIS_VALIDATION");
    options.always_stage = flag_variable("ELVIS_STAGING");

    const std::string buffers = variable("ELVIS_DATA_BUFFERS");
    if (buffers == "texel") {
        options.data_buffers = DataBuffers::texel;
    } else if (buffers == "storage") {
        options.data_buffers = DataBuffers::storage;
    } else if (!buffers.empty()) {
        throw Error("$ELVIS_DATA_BUFFERS", "'" + buffers + "' is neither 'texel' nor 'storage'");
    }

    const std::string submissions = variable("ELVIS_SUBMISSIONS");
    if (submissions == "single") {
        options.submissions = Submissions::single;
    } else if (submissions == "collected") {
        options.submissions = Submissions::collected;
    } else if (!submissions.empty()) {
        throw Error("$ELVIS_SUBMISSIONS", "'" + submissions + "' is neither 'single' nor 'collected'");
    }

    const std::string bytes = variable("ELVIS_MAX_BINDING_BYTES");
    const auto [end, failure] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), options.max_binding_bytes);
    if (!bytes.empty() && (failure != std::errc() || end != bytes.data() + bytes.size())) {
        throw Error("$ELVIS_MAX_BINDING_BYTES", "'" + bytes + "' is not a number of bytes");
    }
    return options;
}

Device::Impl::Impl(const DeviceOptions& device_options) : options(device_options), instance(options.validation) {
    summary = choose_among(instance.summaries(), options.wanted);
    physical = instance.physical_devices().at(summary.index);
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);

    VkPhysicalDeviceVulkan13Properties v13{};
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
    VkPhysicalDeviceVulkan11Properties v11{};
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    v11.pNext = &v13;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &v11;
    vkGetPhysicalDeviceProperties2(physical, &properties);
    limits = properties.properties.limits;
    const SubgroupChoice subgroup = choose_subgroup(physical);
    subgroup_size = options.subgroup_size != 0 ? options.subgroup_size : subgroup.size;
    required_subgroup_size = subgroup.required;
    max_allocation_bytes = std::min(v11.maxMemoryAllocationSize, v13.maxBufferSize);

    texel_buffers =
        options.data_buffers == DataBuffers::automatic ? summary.type == "cpu" : options.data_buffers == DataBuffers::texel;
    max_binding_bytes = texel_buffers ? std::uint64_t{limits.maxTexelBufferElements} * 16 : limits.maxStorageBufferRange;
    // A part is also one allocation. Rounded down to whole texels: limits like 2^32 - 1 occur.
    max_binding_bytes = std::min(max_binding_bytes, max_allocation_bytes) / 16 * 16;
    if (options.max_binding_bytes != 0) {
        max_binding_bytes = std::min(max_binding_bytes, options.max_binding_bytes);
    }
    cache_key = summary.name + "|" + summary.driver + "|" + std::to_string(properties.properties.vendorID) + "|" +
                std::to_string(properties.properties.deviceID) + "|" + std::to_string(properties.properties.driverVersion);
    log_debug("device {}: {} ({}, {}), data in {} buffers", summary.index, summary.name, summary.type, summary.driver,
              texel_buffers ? "texel" : "storage");
    try {
        create_device();
    } catch (...) {
        release();
        throw;
    }
}

void Device::Impl::create_device() {
    device = create_compute_device(physical, {.chooses_subgroup_size = required_subgroup_size != 0}, place());
    const std::uint32_t family = compute_queue_family(physical);
    const bool collects = options.submissions == Submissions::automatic ? summary.type == "discrete"
                                                                        : options.submissions == Submissions::collected;
    queue = std::make_unique<CommandQueue>(physical, device, family, collects, summary.type != "cpu", place());
    pipelines = std::make_unique<PipelineCache>(device, cache_key);
}

void Device::Impl::release() noexcept {
    if (device == VK_NULL_HANDLE) {
        return;
    }
    vkDeviceWaitIdle(device);
    queue.reset();
    kept_pipelines.clear();
    pipelines.reset();
    vkDestroyBuffer(device, staging.buffer, nullptr);
    vkFreeMemory(device, staging.memory, nullptr);
    vkDestroyDevice(device, nullptr);
    device = VK_NULL_HANDLE;
}

Device::Impl::~Impl() { release(); }

std::uint32_t Device::Impl::memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags properties) const {
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        if ((type_bits >> type & 1u) != 0 && (memory.memoryTypes[type].propertyFlags & properties) == properties) {
            return type;
        }
    }
    return UINT32_MAX;
}

Staging& Device::Impl::use_staging() {
    if (staging.mapped != nullptr) {
        return staging;
    }
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = staging_bytes;
    info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (staging.buffer == VK_NULL_HANDLE) {
        check_vulkan(vkCreateBuffer(device, &info, nullptr, &staging.buffer), place(), "creating the staging buffer");
    }
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device, staging.buffer, &needs);
    constexpr VkMemoryPropertyFlags coherent = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    std::uint32_t type = memory_type(needs.memoryTypeBits, coherent | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
    if (type == UINT32_MAX) {
        type = memory_type(needs.memoryTypeBits, coherent); // Vulkan promises one.
    }
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = type;
    if (staging.memory == VK_NULL_HANDLE) {
        check_vulkan(vkAllocateMemory(device, &allocate, nullptr, &staging.memory), place(), "allocating the staging buffer");
        check_vulkan(vkBindBufferMemory(device, staging.buffer, staging.memory, 0), place(), "binding the staging buffer");
    }
    void* mapped = nullptr;
    check_vulkan(vkMapMemory(device, staging.memory, 0, VK_WHOLE_SIZE, 0, &mapped), place(), "mapping the staging buffer");
    staging.mapped = static_cast<std::byte*>(mapped);
    return staging;
}

const TaskControl* Device::Impl::task() {
    const std::lock_guard lock(tasks_mutex);
    const auto found = tasks.find(std::this_thread::get_id());
    return found == tasks.end() ? nullptr : found->second;
}

void Device::Impl::set_task(const TaskControl* control) {
    const std::lock_guard lock(tasks_mutex);
    if (control != nullptr) {
        tasks[std::this_thread::get_id()] = control;
    } else {
        tasks.erase(std::this_thread::get_id());
    }
}

Device::Device(const DeviceOptions& options) : m_impl(std::make_unique<Impl>(options)) {}

Device::Device(const std::string& wanted, bool validation) {
    DeviceOptions options = DeviceOptions::from_environment(wanted);
    options.validation = options.validation || validation;
    m_impl = std::make_unique<Impl>(options);
}

Device::~Device() = default;

const DeviceSummary& Device::summary() const { return m_impl->summary; }
VkDevice Device::handle() const { return m_impl->device; }
VkPhysicalDevice Device::physical() const { return m_impl->physical; }
const VkPhysicalDeviceLimits& Device::limits() const { return m_impl->limits; }
std::uint32_t Device::subgroup_size() const { return m_impl->subgroup_size; }
bool Device::collects_submissions() const { return m_impl->queue->collects(); }
std::uint64_t Device::max_binding_bytes() const { return m_impl->max_binding_bytes; }
bool Device::uses_texel_buffers() const { return m_impl->texel_buffers; }
bool Device::is_validated() const { return m_impl->options.validation; }
std::string Device::cache_key() const { return m_impl->cache_key; }
std::uint64_t Device::allocated_bytes() const { return m_impl->allocated_bytes; }
std::uint64_t Device::n_buffers() const { return m_impl->n_buffers; }
DeviceWork Device::work() const { return {m_impl->queue->n_submissions, m_impl->queue->n_host_waits}; }
std::uint64_t Device::n_kernels() const { return m_impl->n_kernels; }

Background& Device::background() const { return m_impl->background; }

std::vector<KernelBuild> Device::kernel_builds() const {
    const std::lock_guard lock(m_impl->builds_mutex);
    return m_impl->builds;
}

void Device::add(KernelBuild build) const {
    const std::lock_guard lock(m_impl->builds_mutex);
    m_impl->builds.push_back(std::move(build));
}

std::vector<KernelTime> Device::kernel_times() const {
    std::vector<KernelTime> times;
    for (const auto& [name, milliseconds] : m_impl->queue->times()) {
        if (name != CommandQueue::copies) {
            times.push_back({name, milliseconds});
        }
    }
    return times;
}

void Device::tell(const KernelCode& code) const {
    if (m_impl->options.on_kernel) {
        m_impl->options.on_kernel(code);
    }
}

std::vector<std::string> Device::validation_messages() const {
    const ValidationLog& log = m_impl->instance.log();
    const std::lock_guard lock(log.mutex);
    return log.messages;
}

void Device::record(const std::function<void(VkCommandBuffer)>& record) const {
    m_impl->queue->record(CommandQueue::copies, record);
}

void Device::finish() const { m_impl->queue->finish(); }

void Device::check_task() const {
    if (const TaskControl* control = m_impl->task()) {
        control->check();
    }
}

DeviceTask::DeviceTask(const Device& device, const TaskControl* control) : m_device(device), m_before(device.impl().task()) {
    if (control != nullptr) {
        device.impl().set_task(control);
    }
}

DeviceTask::~DeviceTask() { m_device.impl().set_task(m_before); }

} // namespace elvis
