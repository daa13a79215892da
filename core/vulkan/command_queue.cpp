#include <core/vulkan/command_queue.hpp>

#include <core/vulkan/check.hpp>

#include <utility>

namespace elvis {

CommandQueue::CommandQueue(VkPhysicalDevice physical, VkDevice device, std::uint32_t family, bool collects, std::string place)
    : m_device(device), m_clock(physical, device, family, place), m_collects(collects), m_place(std::move(place)) {
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

void CommandQueue::record(const Record& record) {
    const std::lock_guard lock(m_mutex);
    if (!m_is_recording) {
        begin();
    }
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
        submit_and_wait();
    }
}

void CommandQueue::finish() {
    const std::lock_guard lock(m_mutex);
    if (m_is_recording) {
        submit_and_wait();
    }
}

void CommandQueue::submit_and_wait() {
    m_is_recording = false;
    m_clock.stop(m_commands);
    check_vulkan(vkEndCommandBuffer(m_commands), m_place, "recording commands");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &m_commands;
    ++n_submissions;
    check_vulkan(vkQueueSubmit(m_queue, 1, &info, m_fence), m_place, "submitting work");
    ++n_host_waits;
    check_vulkan(vkWaitForFences(m_device, 1, &m_fence, VK_TRUE, UINT64_MAX), m_place, "waiting for the device");
    m_busy_nanoseconds += m_clock.nanoseconds();
    check_vulkan(vkResetFences(m_device, 1, &m_fence), m_place, "resetting a fence");
    do_what_waits();
}

std::optional<double> CommandQueue::busy_milliseconds() {
    const std::lock_guard lock(m_mutex);
    return m_clock.is_there() ? std::optional(1e-6 * m_busy_nanoseconds) : std::nullopt;
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
