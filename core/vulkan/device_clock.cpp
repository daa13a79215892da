#include <core/vulkan/device_clock.hpp>

#include <core/vulkan/check.hpp>
#include <core/vulkan/device_impl.hpp>

#include <utility>
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
    info.queryCount = most_parts + 1;
    check_vulkan(vkCreateQueryPool(device, &info, nullptr, &m_queries), place, "creating its clock");
}

DeviceClock::~DeviceClock() { vkDestroyQueryPool(m_device, m_queries, nullptr); }

void DeviceClock::start(VkCommandBuffer commands) {
    m_parts.clear();
    if (is_there()) {
        vkCmdResetQueryPool(commands, m_queries, 0, most_parts + 1);
    }
}

void DeviceClock::begin_part(VkCommandBuffer commands, const std::string& name, std::function<void(double)> took) {
    if (is_there() && m_parts.size() < most_parts) {
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, m_queries,
                            static_cast<std::uint32_t>(m_parts.size()));
        m_parts.push_back({name, std::move(took)});
    } else if (is_there()) {
        m_parts.back().took = nullptr; // It takes in what comes beyond.
    }
}

void DeviceClock::stop(VkCommandBuffer commands) const {
    if (is_there()) {
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, m_queries,
                            static_cast<std::uint32_t>(m_parts.size()));
    }
}

void DeviceClock::take_times(std::map<std::string, double>& times) {
    std::vector<std::uint64_t> stamps(m_parts.size() + 1);
    if (!is_there() || vkGetQueryPoolResults(m_device, m_queries, 0, static_cast<std::uint32_t>(stamps.size()),
                                             stamps.size() * sizeof stamps[0], stamps.data(), sizeof stamps[0],
                                             VK_QUERY_RESULT_64_BIT) != VK_SUCCESS) {
        return;
    }
    for (std::size_t i = 0; i < m_parts.size(); ++i) {
        const double milliseconds = 1e-6 * m_period * static_cast<double>((stamps[i + 1] - stamps[i]) & m_mask);
        times[m_parts[i].name] += milliseconds;
        if (m_parts[i].took) {
            m_parts[i].took(milliseconds);
        }
    }
    m_parts.clear();
}

std::optional<double> busy_milliseconds(const Device& device) { return device.impl().queue->busy_milliseconds(); }

std::map<std::string, double> device_times(const Device& device) { return device.impl().queue->times(); }

} // namespace elvis
