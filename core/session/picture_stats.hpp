/**
 * @file picture_stats.hpp
 * What a picture took.
 */
#pragma once

#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis {

/** What is known of a picture once it is drawn. */
class PictureStats {
public:
    PictureStats() = default;
    PictureStats(const Device& device, Precision precision, const Frame& frame, const Renderer& renderer);
    /** Without what a renderer knows: times of preparation, bytes on the device. */
    PictureStats(const Device& device, Precision precision, const Frame& frame);

    /** Device, times in milliseconds, counts, memory, kernels. */
    std::string json() const;

private:
    std::string m_device, m_driver;
    Precision m_precision = Precision::float32;
    RendererTimes m_times;
    RendererMemory m_memory;
    double m_render_milliseconds = 0, m_device_milliseconds = 0;
    std::uint64_t m_submissions = 0, m_host_waits = 0;
    FrameCounts m_counts;
    std::vector<KernelBuild> m_kernels;
};

} // namespace elvis
