/**
 * @file instance.hpp
 * The Vulkan instance, with or without validation, and the devices it sees.
 */
#pragma once

#include <core/vulkan/device.hpp>

#include <mutex>
#include <span>

namespace elvis {

/** Messages of the validation layer; written by the driver's threads. */
struct ValidationLog {
    mutable std::mutex mutex;
    std::vector<std::string> messages;
};

class Instance {
public:
    /** `extensions`: names of instance extensions that are wanted besides, such as a window's. */
    explicit Instance(bool validation, std::span<const char* const> extensions = {});
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const { return m_instance; }
    const ValidationLog& log() const { return m_log; }

    std::vector<VkPhysicalDevice> physical_devices() const;
    /** One for each physical device, in the same order. */
    std::vector<DeviceSummary> summaries() const;

private:
    VkInstance m_instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT m_messenger = VK_NULL_HANDLE;
    ValidationLog m_log;
};

} // namespace elvis
