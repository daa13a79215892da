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

    /** Of a picture of this size: of the rays that look for a start. `states`: a core_volume_state a pixel. */
    std::vector<RayBox> seeking(const Buffer& states, std::uint32_t width, std::uint32_t height);
    /** Of those that go on in these elements. Rays that have looked for a start in vain end. */
    std::vector<RayBox> going(const Buffer& states, std::uint32_t width, std::uint32_t height, std::uint32_t first_element,
                              std::uint32_t n_elements);

private:
    struct Parameters;
    std::vector<RayBox> run(const Buffer& states, const Parameters& parameters);

    const Device& m_device;
    std::uint32_t m_tile_width, m_tile_height;
    double m_most_waste;
    ComposedKernel m_kernel;
    std::optional<Buffer> m_ranges;
};

} // namespace elvis
