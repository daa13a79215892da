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
    explicit DeviceTimer(const Device& device) : m_device(device), m_is_processor(device.summary().type == "cpu") {
        device.background().finish();
        device.finish();
        m_processor = processor();
        m_wall = std::chrono::steady_clock::now();
    }

    /** Both wait for the device. */
    double milliseconds() const {
        m_device.finish();
        return m_is_processor ? (processor() - m_processor) / n_processors() : wall_milliseconds();
    }
    double wall_milliseconds() const {
        m_device.finish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - m_wall).count();
    }
    /** By which times were divided; 1 where the device is not the processor. */
    double n_processors() const { return m_is_processor ? std::max(1u, std::thread::hardware_concurrency()) : 1; }

private:
    static double processor() {
        timespec time{};
        ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
    }

    const Device& m_device;
    bool m_is_processor;
    double m_processor;
    std::chrono::steady_clock::time_point m_wall;
};

} // namespace elvis
