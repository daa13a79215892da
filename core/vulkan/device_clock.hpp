/**
 * @file device_clock.hpp
 * How long a device worked, by its own clock: without the host's waits in between.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

class Device;

/** Timestamps between the commands of one submission, which follow each other. One thread at a time. */
class DeviceClock {
public:
    /** Of one submission; the last part takes in what comes beyond. */
    static constexpr std::uint32_t most_parts = 511;

    /** `place`: for messages. Throws Error. */
    DeviceClock(VkPhysicalDevice physical, VkDevice device, std::uint32_t queue_family, const std::string& place);
    ~DeviceClock();
    DeviceClock(const DeviceClock&) = delete;
    DeviceClock& operator=(const DeviceClock&) = delete;

    void start(VkCommandBuffer commands);
    /** From here on, until the next one. */
    void begin_part(VkCommandBuffer commands, const std::string& name);
    void stop(VkCommandBuffer commands) const;

    struct Part {
        std::string name;
        double milliseconds = 0;
    };
    /** What the parts took, once they are over; none where the device has no clock. */
    std::vector<Part> parts() const;
    bool is_there() const { return m_queries != VK_NULL_HANDLE; }

private:
    VkDevice m_device;
    VkQueryPool m_queries = VK_NULL_HANDLE;
    /** Bits of a timestamp that count, and the nanoseconds of one. */
    std::uint64_t m_mask = 0;
    double m_period = 0;
    /** Begun since the start. */
    std::vector<std::string> m_names;
};

/** All submissions of a device so far; nothing where it has no clock. */
std::optional<double> busy_milliseconds(const Device& device);
/** The same by kernel, and "copies". */
std::map<std::string, double> device_times(const Device& device);

} // namespace elvis
