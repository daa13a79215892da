/**
 * @file device_clock.hpp
 * How long a device worked, by its own clock: without the host's waits in between.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <string>

namespace elvis {

class Device;

/** Two timestamps around each submission. One thread at a time. */
class DeviceClock {
public:
    /** `place`: for messages. Throws Error. */
    DeviceClock(VkPhysicalDevice physical, VkDevice device, std::uint32_t queue_family, const std::string& place);
    ~DeviceClock();
    DeviceClock(const DeviceClock&) = delete;
    DeviceClock& operator=(const DeviceClock&) = delete;

    void start(VkCommandBuffer commands) const;
    void stop(VkCommandBuffer commands) const;
    /** Nanoseconds between the two, once they are over; 0 where the device has no clock. */
    double nanoseconds() const;
    bool is_there() const { return m_queries != VK_NULL_HANDLE; }

private:
    VkDevice m_device;
    VkQueryPool m_queries = VK_NULL_HANDLE;
    /** Bits of a timestamp that count, and the nanoseconds of one. */
    std::uint64_t m_mask = 0;
    double m_period = 0;
};

/** All submissions of a device so far; nothing where it has no clock. */
std::optional<double> busy_milliseconds(const Device& device);

} // namespace elvis
