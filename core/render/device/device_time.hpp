/**
 * @file device_time.hpp
 * How long the device has worked.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/vulkan/device.hpp>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>

namespace elvis {

/**
 * Time since construction, which waits until kernels that were made before are compiled. On devices that are the processor,
 * this process's processor time over the number of processors: what an idle machine would take, whatever else runs. On others
 * wall time.
 */
class DeviceTimer {
public:
    /** `waits`: for the device, now and when it is asked. Else what is pending counts in the part of a frame that waits for it.
     */
    explicit DeviceTimer(const Device& device, bool waits = true)
        : m_device(device), m_waits(waits), m_is_processor(device.summary().type == "cpu") {
        device.background().finish();
        finish();
        m_processor = processor();
        m_wall = std::chrono::steady_clock::now();
    }

    double milliseconds() const {
        finish();
        return m_is_processor ? (processor() - m_processor) / n_processors() : wall_milliseconds();
    }
    double wall_milliseconds() const {
        finish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - m_wall).count();
    }
    /** By which times were divided; 1 where the device is not the processor. */
    double n_processors() const { return m_is_processor ? std::max(1u, std::thread::hardware_concurrency()) : 1; }

private:
    void finish() const {
        if (m_waits) {
            m_device.finish();
        }
    }
    static double processor() {
        timespec time{};
        ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
    }

    const Device& m_device;
    bool m_waits, m_is_processor;
    double m_processor;
    std::chrono::steady_clock::time_point m_wall;
};

} // namespace elvis
