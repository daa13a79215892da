/**
 * @file live_rays.hpp
 * Where in a picture rays through the volume have something to do.
 */
#pragma once

#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

/** A box of a picture: tiles from `first` to before `end` across, and rows of pixels. */
struct RayBox {
    std::uint32_t first = 0, end = 0, first_row = 0, end_row = 0;

    std::uint64_t area() const { return std::uint64_t{end - first} * (end_row - first_row); }
};

/**
 * Boxes that hold all that is in the ranges, `first, end` for each row of tiles (first >= end: nothing). Neighbours become one where
 * that takes in at most `most_waste` times what they hold.
 */
std::vector<RayBox> boxes_of(std::span<const std::uint32_t> ranges, std::uint32_t tile_height, std::uint32_t height, double most_waste);

class LiveRays {
public:
    LiveRays(const Device& device, Precision precision, std::uint32_t tile_width, std::uint32_t tile_height);

    /** A picture of this size, of which all rays look for a start. `states`: a core_volume_state a pixel; `has_starts`: a word a tile, 0
     * where rays can start in nothing. Both must outlive what follows. */
    void begin(const Buffer& states, const Buffer& has_starts, std::uint32_t width, std::uint32_t height);
    /** Of the rays that look for a start. Those that can find none end. */
    std::vector<RayBox> seeking();
    /** Of those that go on in these elements. Rays that have looked for a start in vain end. */
    std::vector<RayBox> going(std::uint32_t first_element, std::uint32_t n_elements);

private:
    struct Parameters;
    std::vector<RayBox> run(std::uint32_t seeks, std::uint32_t first_element, std::uint32_t n_elements);

    const Device& m_device;
    std::uint32_t m_tile_width, m_tile_height;
    double m_most_waste;
    ComposedKernel m_kernel;
    std::optional<Buffer> m_ranges;
    const Buffer *m_states = nullptr, *m_has_starts = nullptr;
    std::uint32_t m_width = 0, m_height = 0;
    /** Holds all rays that have not ended. */
    RayBox m_all;
    bool m_is_first = true;
};

} // namespace elvis
