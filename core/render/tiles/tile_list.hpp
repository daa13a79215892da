/**
 * @file tile_list.hpp
 * The tiles of a picture, and which of them are to be drawn.
 */
#pragma once

#include <core/vulkan/buffer.hpp>
#include <core/vulkan/device.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>

namespace elvis {

/** Whole subgroups, as drivers pack lanes along x, and no wider: a narrow tile has a short list of nodes. */
inline std::uint32_t tile_width_on(const Device& device) { return std::clamp(device.subgroup_size(), 8u, 64u); }

/**
 * Rows of pixels that an invocation draws one after the other, each from where the last one's search ended, of `many` that it
 * may. A processor gains by that. A GPU would be half idle, and wait for the time of each search: it takes `few`.
 */
inline std::uint32_t rows_an_invocation(const Device& device, std::uint32_t many, std::uint32_t few) {
    return device.summary().type == "cpu" ? many : few;
}

/** Rows of a tile of which an invocation draws a column. They divide part_rows. */
inline std::uint32_t tile_height_on(const Device& device) { return rows_an_invocation(device, 16, 2); }

/**
 * Tiles that see something, as kernels put them there (shaders/tiles/list_tile.glsl): where many pixels share each
 * instruction, kernels go through an empty tile as long as through a full one, so these alone are drawn.
 */
class TileList {
public:
    /** Tiles from `first` on in the list, in no order, as kernels read them (shaders/tiles/listed_tile.glsl). */
    struct Range {
        std::uint32_t first, count;
    };
    struct Ranges {
        /** Of tiles/ray_tiles.comp: those whose lists hold leaves only, and those with inner nodes. Others have one range. */
        Range shallow, deep;
    };

    explicit TileList(const Device& device) : m_device(device) {}

    /** An empty list, for so many tiles. It is good until the next one. */
    const Buffer& begin(std::uint32_t n_tiles);
    /** What the list holds since begin(). */
    Ranges read() const;
    /** For Buffer::read_together, and what was read then. */
    static constexpr std::size_t n_header_words = 2;
    Ranges ranges(std::span<const std::uint32_t, n_header_words> header) const;

    /** Whether the first range can be drawn before the host knows how many it has: it begins with `n_header_words`. */
    bool is_indirect() const;
    /** Of Kernel::dispatch_indirect(), with a work group for each tile of that range along x, and so many along y. */
    const Buffer& groups(std::uint32_t groups_y = 1);
    const Buffer& buffer() const { return *m_buffer; }

private:
    const Device& m_device;
    std::uint32_t m_n_tiles = 0;
    std::optional<Buffer> m_buffer, m_groups;
};

} // namespace elvis
