/**
 * @file open_points.hpp
 * Points of cut surfaces that may lie in an element although Newton's method has not found them there.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/element/element_octants.hpp>
#include <core/volume/element/element_reaches.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/**
 * For the passes of one field on cut surfaces. The kernels that search whole elements list pixels
 * (shaders/cut_surface/open_points.glsl). Once all classes are drawn, those that linear models of octants do not rule out
 * (shaders/cut_surface/sift_points.comp) are searched octant by octant. Kernels and octants are made when they are first
 * needed.
 */
class OpenPoints {
public:
    OpenPoints(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, bool is_on_plane);

    /** What the surface's passes share. */
    struct Surface {
        std::uint32_t number;
        const ShownComponent& component;
        const LayerTarget& target;
        /** View and counts. */
        const Buffer& frame;
        const Buffer& counts;
        /** Unless it is a plane: the crossings, and the most that a point's error may be. */
        const Buffer* hits = nullptr;
        float most_error = 0;
    };

    /** For kernels that draw pixels of a class: what dismisses points, if there is something (`core_reaches`). */
    std::vector<FetchBuffer> buffers(std::uint32_t element_class) const;
    /** An empty list for them, and where they say of which elements they would like to know more. */
    std::array<const Buffer*, 2> begin(std::uint32_t element_class, std::uint64_t n_pixels);
    /** Searches what the class's list holds. */
    void search(std::uint32_t element_class, const Surface& surface);

private:
    struct OfClass {
        std::optional<Buffer> list;
        /** Only if there are strongly bent elements. */
        std::unique_ptr<ElementReaches> reaches;
        std::unique_ptr<ElementOctants> octants;
        std::unique_ptr<ComposedKernel> sift, search;
    };
    void provide_kernels(std::uint32_t element_class);
    Buffer& empty_list(std::optional<Buffer>& list, std::uint64_t bytes) const;
    /** `output`: where the kernel writes sifted points, or counts. */
    void dispatch(const ComposedKernel& kernel, const Buffer& output, const Buffer& list, std::uint32_t n_listed,
                  const OfClass& of_class, const Surface& surface) const;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    const DeviceVolume& m_data;
    bool m_is_on_plane;
    std::vector<OfClass> m_classes;
    /** Of one class after the other: points that linear models do not rule out. As long as lists, whatever they hold. */
    std::optional<Buffer> m_sifted;
};

} // namespace elvis
