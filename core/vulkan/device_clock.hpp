/**
 * @file device_clock.hpp
 * How long a device worked, by its own clock: without the host's waits in between.
 */
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
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
    /** From here on, until the next one. `took`: called by take_times(). */
    void begin_part(VkCommandBuffer commands, const std::string& name, std::function<void(double milliseconds)> took);
    void stop(VkCommandBuffer commands) const;
    /** Once the parts are over: adds what they took, in milliseconds by name; nothing where the device has no clock. */
    void take_times(std::map<std::string, double>& times);
    bool is_there() const { return m_queries != VK_NULL_HANDLE; }

private:
    VkDevice m_device;
    VkQueryPool m_queries = VK_NULL_HANDLE;
    /** Bits of a timestamp that count, and the nanoseconds of one. */
    std::uint64_t m_mask = 0;
    double m_period = 0;
    struct Part {
        std::string name;
        std::function<void(double)> took;
    };
    /** Begun since the start. */
    std::vector<Part> m_parts;
};

/** All submissions of a device so far; nothing where it has no clock. */
std::optional<double> busy_milliseconds(const Device& device);
/** The same by kernel, and "copies". */
std::map<std::string, double> device_times(const Device& device);

} // namespace elvis
