/**
 * @file renderer.hpp
 * Draws frames of one volume on one device.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/frame.hpp>
#include <core/vulkan/device.hpp>

#include <memory>

namespace elvis {

struct RendererTimes {
    double upload_milliseconds = 0;
    double hierarchy_milliseconds = 0;
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
 * (core/vulkan/dispatch_pace.hpp): other work on the device, a window's, comes in between.
 */
class Renderer {
public:
    Renderer(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control = nullptr);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /** Bounds of the whole volume: min x y z, max x y z. */
    std::array<double, 6> bounds() const;
    /** How far the volume reaches in every direction (core/volume/outline.hpp); found when it is first asked for. */
    const std::vector<Vector3>& outline();
    /**
     * Extrema of a field (component, magnitude or expression) over the volume at a time step: to a thousandth of their distance
     * where the plugin has bounds, else of samples.
     */
    FieldExtrema field_extrema(const FieldChoice& field, std::uint32_t time_step);
    /** What encloses them, wider, and whether it is certified. */
    FieldRange field_range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty = nullptr);
    /**
     * About what rounding costs its values, to tell whether the range is more than that. 0 for components of fields, which lack
     * the middle of their range on the device, and where the range is certainly more.
     */
    double value_rounding(const FieldChoice& field, std::uint32_t time_step);

    /**
     * Draws a picture. With a control it can be cancelled from another thread: then Cancelled is thrown within some 50 ms,
     * other than while a driver compiles a kernel for the first time, and the next picture is what it would have been anyway.
     */
    Frame render(const FrameRequest& request, const TaskControl* control = nullptr);

    const RendererTimes& times() const;
    RendererMemory memory() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
