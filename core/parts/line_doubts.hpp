/**
 * @file line_doubts.hpp
 * Lines of a surface where its part may not know what the picture shows.
 */
#pragma once

#include <core/parts/part_picture.hpp>
#include <core/parts/tile_shares.hpp>
#include <core/render/frame.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace elvis {

/** How many pixels around a pixel must be known to put it together. */
std::uint32_t reach_of_fold(const FrameRequest& request);

/** Of what parts show, the one that a pixel is of: the part, and which of its layers. */
struct LayerOfPart {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t part = none, layer = 0;
};

/**
 * Flags lines as undecided (2, 512) in pixels near which their part does not see what the picture shows. Lines of one pixel
 * depend on what lies in the pixel, so on neighbours that show the same surface; wide ones on all from where they reach the
 * pixel.
 */
class LineDoubts {
public:
    /** `request`: of one surface. `parts`: what they show of the block, layer after layer. All must outlive it. */
    LineDoubts(const FrameRequest& request, const PixelBlock& block, std::span<const PartPixels> parts);

    /** Whether there are lines. */
    bool are_possible() const { return m_flags != 0; }
    /** `frame`: the block as the picture has it, or one layer of it; flags are added. `sources`: of each pixel. */
    void flag(std::span<const LayerOfPart> sources, Frame& frame) const;

private:
    struct PartLayers;
    bool is_open(const PartLayers& seen, std::uint32_t layer, std::size_t pixel, const Frame& frame) const;
    Vector3 point_seen(std::size_t pixel, const Frame& frame) const;
    bool may_be_one_surface(std::size_t pixel, std::size_t other, const Frame& frame) const;

    const FrameRequest& m_request;
    const PixelBlock& m_block;
    std::span<const PartPixels> m_parts;
    double m_width;
    int m_reach;
    std::uint32_t m_flags;
};

} // namespace elvis
