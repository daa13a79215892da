/**
 * @file draw_on_demand.hpp
 * Pictures for which only those elements are read and uploaded that they need, within budgets of memory.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/demand/memory_need.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>
#include <core/session/still_picture.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <memory>

namespace elvis {

/** What a picture took. */
struct DemandWork {
    /** Of the volume; on the device at once, at most. */
    std::uint64_t n_elements = 0, n_on_device = 0;
    /** Of rows that were drawn one after the other. */
    std::uint32_t n_bands = 0;
    /** The most at once. What the host had is 0 if the system does not tell. */
    std::uint64_t device_bytes = 0, host_bytes = 0;
    double bounds_milliseconds = 0;
};

/**
 * Cut planes need the elements that they meet in the picture, boundaries those that have a part in them, isosurfaces those in
 * which the field may take the isovalues; for these elements alone records are asked for. Where they do not fit, planes are
 * drawn in bands of rows. What needs all elements is drawn if they fit. Pictures are those of the whole volume, to the bit;
 * what does not fit is an Error before anything is uploaded, which says what it needs.
 */
class VolumeOnDemand {
public:
    /** Reads the bounds of all elements. All must outlive it. Throws Error for a volume whose elements cannot be chosen. */
    VolumeOnDemand(const RuntimeVolume& whole, const Device& device, Precision precision, const MemoryBudget& budget,
                   const TaskControl* control = nullptr);
    ~VolumeOnDemand();
    VolumeOnDemand(const VolumeOnDemand&) = delete;
    VolumeOnDemand& operator=(const VolumeOnDemand&) = delete;

    /** By one device. Throws Error, also for scenes that are not drawn within budgets yet. */
    StillPicture draw(const Scene& scene, const StillOptions& options = {});
    /** The picture of a request that was made of the scene by ranges(). Remarks are those on this frame alone. */
    StillPicture draw_request(const Scene& scene, FrameRequest request, const StillOptions& options = {});

    /** What pictures go by; an Error where the budget lets nothing be known. */
    PictureRanges& ranges();
    /** The same for remarks: then about. */
    PictureRanges& rough_ranges();

    /** Of the last picture. */
    const DemandWork& work() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
