#include <core/vulkan/device_clock.hpp>

#include <core/vulkan/check.hpp>
#include <core/vulkan/device_impl.hpp>

#include <array>
#include <vector>

namespace elvis {

DeviceClock::DeviceClock(VkPhysicalDevice physical, VkDevice device, std::uint32_t queue_family, const std::string& place)
    : m_device(device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    const std::uint32_t bits = families.at(queue_family).timestampValidBits;
    if (bits == 0) {
        return;
    }
    m_mask = ~std::uint64_t{0} >> (64 - bits);
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    m_period = static_cast<double>(properties.limits.timestampPeriod);
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 2;
    check_vulkan(vkCreateQueryPool(device, &info, nullptr, &m_queries), place, "creating its clock");
}

DeviceClock::~DeviceClock() { vkDestroyQueryPool(m_device, m_queries, nullptr); }

void DeviceClock::start(VkCommandBuffer commands) const {
    if (is_there()) {
        vkCmdResetQueryPool(commands, m_queries, 0, 2);
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, m_queries, 0);
    }
}

void DeviceClock::stop(VkCommandBuffer commands) const {
    if (is_there()) {
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, m_queries, 1);
    }
}

double DeviceClock::nanoseconds() const {
    std::array<std::uint64_t, 2> stamps{};
    if (!is_there() || vkGetQueryPoolResults(m_device, m_queries, 0, 2, sizeof stamps, stamps.data(), sizeof stamps[0],
                                             VK_QUERY_RESULT_64_BIT) != VK_SUCCESS) {
        return 0;
    }
    return m_period * static_cast<double>((stamps[1] - stamps[0]) & m_mask);
}

std::optional<double> busy_milliseconds(const Device& device) { return device.impl().queue->busy_milliseconds(); }

} // namespace elvis
