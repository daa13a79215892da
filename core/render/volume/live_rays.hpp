/**
 * @file live_rays.hpp
 * Where in a picture rays through the volume have something to do.
 */
#pragma once

#include <core/render/device/in_batches.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace elvis {

/**
 * Of a group of rays: as many pixels as a tile is wide, in a rectangle that divides the tile (shaders/tiles/ray_group.glsl).
 */
struct GroupShape {
    std::uint32_t width = 0, height = 0;

    explicit GroupShape(std::uint32_t tile_width);
    /** For kernels. */
    std::pair<std::string, std::string> define() const;
};

/** Rays of pixels, in groups. `list` holds the number of each group, row by row. */
struct RayGroups {
    const Buffer* list = nullptr;
    /** If the device alone knows it, the most that it can be. */
    std::uint32_t count = 0;
    /** Then, what it knows: the size of a dispatch. */
    const Buffer* size = nullptr;

    /** Of a kernel with a work group for each group of rays; `parameters` tell it by `first_group` where in the list it begins.
     */
    template <class Parameters>
    void dispatch(const ComposedKernel& kernel, std::span<const Buffer* const> bindings, Parameters parameters) const {
        parameters.first_group = 0;
        if (size != nullptr) {
            kernel.dispatch_indirect(bindings, std::as_bytes(std::span(&parameters, 1)), *size);
            return;
        }
        in_batches(count, most_groups, [&](std::uint32_t first, std::uint32_t n) {
            parameters.first_group = first;
            kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), n);
        });
    }
};

/** All groups of a picture, by ascending number. */
class AllRayGroups {
public:
    /** Good until the next call. */
    RayGroups of(const Device& device, const GroupShape& shape, std::uint32_t width, std::uint32_t height);

private:
    std::optional<Buffer> m_list;
};

class LiveRays {
public:
    LiveRays(const Device& device, Precision precision, std::uint32_t tile_width, std::uint32_t tile_height);

    /** A picture of this size, of which all rays look for a start. `states`: a core_volume_state a pixel; `has_starts`: a word
     * a tile, 0 where rays can start in nothing. Both must outlive what follows. */
    void begin(const Buffer& states, const Buffer& has_starts, std::uint32_t width, std::uint32_t height);
    /** All groups of the picture. */
    RayGroups all() const { return m_all; }
    /** Groups in which rays look for a start, in no order. Those that can find none end. Good until the next call. */
    RayGroups seeking();
    /** Of those that go on in these elements, likewise. Rays that have looked for a start in vain end. */
    RayGroups going(std::uint32_t first_element, std::uint32_t n_elements);

private:
    struct Parameters;
    RayGroups run(std::uint32_t seeks, std::uint32_t first_element, std::uint32_t n_elements);

    const Device& m_device;
    GroupShape m_shape;
    ComposedKernel m_kernel;
    Buffer m_counts;
    AllRayGroups m_all_groups;
    RayGroups m_all;
    /** Groups whose rays have not all ended; seeking() makes the next of these lists from the last one. */
    RayGroups m_open;
    std::optional<Buffer> m_live, m_open_lists[2];
    std::size_t m_next_open = 0;
    /** The device alone knows the size of lists, and this side need not wait for it. */
    bool m_is_indirect = false;
    const Buffer *m_states = nullptr, *m_has_starts = nullptr;
    std::uint32_t m_width = 0, m_height = 0;
};

} // namespace elvis
