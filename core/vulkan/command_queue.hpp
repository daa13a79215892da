/**
 * @file command_queue.hpp
 * The way of work to a device.
 */
#pragma once

#include <core/vulkan/device_clock.hpp>

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/**
 * Commands in the order in which they are recorded: each sees what those before it have written. Either each is submitted and
 * waited for at once, or they are collected until this side wants to see a result (finish): on a device of its own, a
 * submission with a wait costs as much as a small kernel. Any thread.
 */
class CommandQueue {
public:
    /** The name of all that is no kernel. */
    static constexpr const char* copies = "copies";

    /** `asks`: this side does not sleep while it waits for what takes little time. `place`: for errors. */
    CommandQueue(VkPhysicalDevice physical, VkDevice device, std::uint32_t family, bool collects, bool asks, std::string place);
    ~CommandQueue();
    CommandQueue(const CommandQueue&) = delete;
    CommandQueue& operator=(const CommandQueue&) = delete;

    bool collects() const { return m_collects; }

    /**
     * `record`: called at once, while no other thread records or submits. `name`: whose time it is. `took`: called once it has
     * been done, where the device has a clock.
     */
    using Record = std::function<void(VkCommandBuffer)>;
    using Took = std::function<void(double milliseconds)>;
    void record(const std::string& name, const Record& record, Took took = {});
    /** Submits what was collected, if anything was, and waits: then all of it has been done. A lost device is an Error. */
    void finish();
    /** Something was collected that is not done. */
    bool is_pending() const { return m_is_recording; }

    /** Grows with each submission. What was used in one may be used anew in the next. To be asked inside of record(). */
    std::uint64_t submission() const { return n_submissions; }

    /** Whether what was recorded in a submission has been done. */
    bool is_done(std::uint64_t submission) const { return m_n_done > submission; }

    /** Does it once all that was recorded so far has been done: at once if nothing is pending. It must not throw. */
    void when_done(std::function<void()> what) noexcept;

    /** Submissions, and how often this side waited. */
    std::atomic<std::uint64_t> n_submissions{0}, n_host_waits{0};
    /** How long the device worked on all that was submitted, by its own clock; nothing where it has none. */
    std::optional<double> busy_milliseconds();
    /**
     * The same in milliseconds by name. Without a clock, what this side waited, if commands are not collected. A first run may
     * include a part of the driver's work.
     */
    std::map<std::string, double> times();

private:
    void create(std::uint32_t family);
    void begin();
    /** These need the mutex. */
    void submit_and_wait(const std::string& last_name);
    void wait();
    void take_times(const std::string& last_name, double waited_milliseconds);
    void do_what_waits() noexcept;
    void release() noexcept;

    VkDevice m_device;
    DeviceClock m_clock;
    std::map<std::string, double> m_times;
    bool m_collects, m_asks;
    std::string m_place;
    VkQueue m_queue = VK_NULL_HANDLE;
    VkCommandPool m_pool = VK_NULL_HANDLE;
    VkCommandBuffer m_commands = VK_NULL_HANDLE;
    VkFence m_fence = VK_NULL_HANDLE;
    std::mutex m_mutex;
    std::atomic<bool> m_is_recording{false};
    std::atomic<std::uint64_t> m_n_done{0};
    std::vector<std::function<void()>> m_waiting;
};

} // namespace elvis
