#include <core/vulkan/command_queue.hpp>

#include <core/base/milliseconds.hpp>
#include <core/vulkan/check.hpp>

#include <chrono>
#include <utility>

namespace elvis {

namespace {

/** How long a device is asked whether it is done, before this side sleeps. */
constexpr double most_asking_milliseconds = 5;

} // namespace

CommandQueue::CommandQueue(VkPhysicalDevice physical, VkDevice device, std::uint32_t family, bool collects, bool asks,
                           std::string place)
    : m_device(device), m_clock(physical, device, family, place), m_collects(collects), m_asks(asks),
      m_place(std::move(place)) {
    try {
        create(family);
    } catch (...) {
        release();
        throw;
    }
}

void CommandQueue::create(std::uint32_t family) {
    vkGetDeviceQueue(m_device, family, 0, &m_queue);
    VkCommandPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool_info.queueFamilyIndex = family;
    check_vulkan(vkCreateCommandPool(m_device, &pool_info, nullptr, &m_pool), m_place, "creating the command pool");
    VkCommandBufferAllocateInfo commands_info{};
    commands_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands_info.commandPool = m_pool;
    commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands_info.commandBufferCount = 1;
    check_vulkan(vkAllocateCommandBuffers(m_device, &commands_info, &m_commands), m_place, "allocating commands");
    VkFenceCreateInfo fence_info{};
    fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    check_vulkan(vkCreateFence(m_device, &fence_info, nullptr, &m_fence), m_place, "creating a fence");
}

CommandQueue::~CommandQueue() {
    // What nobody has asked for is not done. What was submitted is.
    do_what_waits();
    release();
}

void CommandQueue::release() noexcept {
    vkDestroyFence(m_device, m_fence, nullptr);
    vkDestroyCommandPool(m_device, m_pool, nullptr);
}

void CommandQueue::begin() {
    check_vulkan(vkResetCommandPool(m_device, m_pool, 0), m_place, "resetting commands");
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check_vulkan(vkBeginCommandBuffer(m_commands, &begin), m_place, "recording commands");
    m_clock.start(m_commands);
    m_is_recording = true;
}

void CommandQueue::record(const std::string& name, const Record& record, Took took) {
    const std::lock_guard lock(m_mutex);
    if (!m_is_recording) {
        begin();
    }
    m_clock.begin_part(m_commands, name, std::move(took));
    record(m_commands);
    // What was written becomes visible to everything that follows: later commands and the host.
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(m_commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0,
                         nullptr);
    if (!m_collects) {
        submit_and_wait(name);
    }
}

void CommandQueue::finish() {
    const std::lock_guard lock(m_mutex);
    if (m_is_recording) {
        submit_and_wait({});
    }
}

void CommandQueue::submit_and_wait(const std::string& last_name) {
    m_is_recording = false;
    m_clock.stop(m_commands);
    check_vulkan(vkEndCommandBuffer(m_commands), m_place, "recording commands");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &m_commands;
    ++n_submissions;
    const auto start = std::chrono::steady_clock::now();
    check_vulkan(vkQueueSubmit(m_queue, 1, &info, m_fence), m_place, "submitting work");
    ++n_host_waits;
    wait();
    m_n_done = n_submissions.load();
    take_times(last_name, milliseconds_since(start));
    check_vulkan(vkResetFences(m_device, 1, &m_fence), m_place, "resetting a fence");
    do_what_waits();
}

void CommandQueue::wait() {
    // To be woken takes longer than most work does. A device that is not the processor leaves it the time to ask.
    const auto start = std::chrono::steady_clock::now();
    while (m_asks && milliseconds_since(start) < most_asking_milliseconds) {
        const VkResult result = vkGetFenceStatus(m_device, m_fence);
        if (result == VK_SUCCESS) {
            return;
        }
        if (result != VK_NOT_READY) {
            check_vulkan(result, m_place, "waiting for the device");
        }
    }
    check_vulkan(vkWaitForFences(m_device, 1, &m_fence, VK_TRUE, UINT64_MAX), m_place, "waiting for the device");
}

void CommandQueue::take_times(const std::string& last_name, double waited_milliseconds) {
    m_clock.take_times(m_times);
    if (!m_clock.is_there() && !last_name.empty()) {
        m_times[last_name] += waited_milliseconds;
    }
}

std::optional<double> CommandQueue::busy_milliseconds() {
    const std::lock_guard lock(m_mutex);
    if (!m_clock.is_there()) {
        return {};
    }
    double sum = 0;
    for (const auto& [name, milliseconds] : m_times) {
        sum += milliseconds;
    }
    return sum;
}

std::map<std::string, double> CommandQueue::times() {
    const std::lock_guard lock(m_mutex);
    return m_times;
}

void CommandQueue::do_what_waits() noexcept {
    for (const std::function<void()>& what : std::exchange(m_waiting, {})) {
        what();
    }
}

void CommandQueue::when_done(std::function<void()> what) noexcept {
    const std::lock_guard lock(m_mutex);
    if (m_is_recording) {
        m_waiting.push_back(std::move(what));
    } else {
        what();
    }
}

} // namespace elvis
