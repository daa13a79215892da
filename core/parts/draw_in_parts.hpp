/**
 * @file draw_in_parts.hpp
 * Pictures of a volume that is drawn part by part, by one process or by several that have different parts.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/team.hpp>
#include <core/parts/parted_volume.hpp>
#include <core/parts/partition.hpp>
#include <core/parts/shared_fold.hpp>
#include <core/scene/scene.hpp>
#include <core/session/still_picture.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace elvis {

/** What one process had of a picture. */
struct PartsWork {
    std::uint32_t rank = 0;
    /** Parts that hold elements; of them elements, with those around them. */
    std::uint64_t n_parts = 0, n_own_elements = 0, n_elements = 0;
    /** On the device. */
    std::uint64_t device_bytes = 0;
    /** Of the picture itself, not of more samples a pixel. */
    FoldWork fold{};
    /** Most that the process has had in memory so far; 0 if the system does not tell. */
    std::uint64_t peak_memory_bytes = 0;
};

/** A picture of the whole volume, on the team's first process; elsewhere without any pixel. */
struct PartsPicture {
    StillPicture still;
    /** By rank; on the first alone. */
    std::vector<PartsWork> work;
    /** Of light: runs of all parts, and how long the process that took longest was about putting its share together. */
    std::uint64_t n_runs = 0;
    double fold_milliseconds = 0;
};

/**
 * A volume in parts (core/parts/partition.hpp). Each process opens, with those elements around them that lie close by,
 * the parts that it owns, and nothing else. The picture is the same to the bit for every number of processes, and that of the
 * whole volume but for rounding.
 */
class VolumeInParts {
public:
    /** All must outlive it. Called by all members of the team, as are all functions. */
    VolumeInParts(const PartedVolume& volume, const Device& device, Precision precision, Partition partition, Team& team,
                  const TaskControl* control = nullptr);
    ~VolumeInParts();
    VolumeInParts(const VolumeInParts&) = delete;
    VolumeInParts& operator=(const VolumeInParts&) = delete;

    /**
     * Throws Error for what cannot be drawn in parts (need_parts_can_draw). Without buffers the picture has colours and counts;
     * the first process then gets less than half of the bytes. Of several samples a pixel so many are in memory at once, whole
     * rows of them.
     */
    PartsPicture draw(const Scene& scene, bool with_buffers = true, std::uint32_t most_fine_pixels = 1u << 22);

    /** What this process had of the last picture. */
    const PartsWork& own_work() const;

    /** Values of these fields have changed; the mesh stays on the device. */
    void forget_fields(std::span<const std::uint32_t> fields);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/** Throws Error if the scene has what is surely not drawn in parts: several volumes, a budget of memory. */
void need_parts_can_draw(const Scene& scene);

} // namespace elvis
