/**
 * @file renderer.hpp
 * Draws frames of one volume on one device.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/volume_ranges.hpp>
#include <core/render/frame.hpp>
#include <core/vulkan/device.hpp>

#include <memory>
#include <optional>

namespace elvis {

struct RendererTimes {
    double upload_milliseconds = 0;
    double hierarchy_milliseconds = 0;
    double overlaps_milliseconds = 0;
    double compile_milliseconds = 0;
};

/** Bytes on the device, for `elvis bench` and statistics. */
struct RendererMemory {
    std::uint64_t field_bytes = 0;
    std::uint64_t geometry_bytes = 0;
    std::uint64_t hierarchy_bytes = 0;
};

/**
 * Keeps the volume's buffers, hierarchies and kernels between frames: the first frame uploads and compiles what it needs, later
 * ones only what changed (field, time step). Device and volume must outlive it. One thread at a time. No dispatch takes long
 * (core/vulkan/kernel/dispatch_pace.hpp): other work on the device, a window's, comes in between.
 */
class Renderer {
public:
    /**
     * `bounds_of_whole`: where the volume is a part of a larger one, which pictures are to be like those of.
     * `expects_overlaps`: it is not looked for whether elements overlap; cut surfaces tell at each pixel. Where they do not,
     * pictures are the same, to the bit.
     */
    Renderer(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control = nullptr,
             const std::optional<std::array<double, 6>>& bounds_of_whole = {}, bool expects_overlaps = false);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /** Where the volume lies, and which values its fields take: what requests are made from. */
    VolumeRanges& ranges();

    /**
     * Draws a picture. With a control it can be cancelled from another thread: then Cancelled is thrown within some 50 ms,
     * other than while a driver compiles a kernel for the first time, and the next picture is what it would have been anyway.
     */
    Frame render(const FrameRequest& request, const TaskControl* control = nullptr);

    /** Pixels of such a picture that the device can bind buffers for. */
    std::uint64_t most_pixels(const FrameRequest& request) const;

    /** Values of a field, or of all, have changed, at any time step: the next frame asks the plugin for all that rests on them.
     */
    void forget_fields(std::optional<std::uint32_t> only = {});

    const RendererTimes& times() const;
    RendererMemory memory() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
