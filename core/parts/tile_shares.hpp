/**
 * @file tile_shares.hpp
 * Which process puts together which pixels of a picture.
 */
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Pixels of a picture: a rectangle. */
struct PixelBlock {
    std::uint32_t first_column = 0, first_row = 0, width = 0, height = 0;

    std::size_t n_pixels() const { return std::size_t{width} * height; }
    /** Of a pixel in it, given by its number in the whole picture. */
    std::uint32_t local(std::uint32_t pixel, std::uint32_t picture_width) const {
        return (pixel / picture_width - first_row) * width + pixel % picture_width - first_column;
    }
};

/**
 * A picture in square tiles. They are dealt to the processes along a curve that stays close by (Morton, 1966): each has tiles
 * everywhere in the picture, and one or none more than the others, so that what is seen in some places alone is work for all.
 * What a picture shows does not depend on tiles.
 */
class TileShares {
public:
    /** `most_reach`: pixels around a tile that must be known to put it together, at most. */
    TileShares(std::uint32_t width, std::uint32_t height, std::uint32_t n_shares, std::uint32_t most_reach);

    std::uint32_t width() const { return m_width; }
    std::size_t n_pixels() const { return std::size_t{m_width} * m_height; }
    std::uint32_t n_shares() const { return static_cast<std::uint32_t>(m_tiles.size()); }
    std::uint32_t n_tiles() const { return static_cast<std::uint32_t>(m_owners.size()); }
    std::uint32_t owner(std::uint32_t tile) const { return m_owners[tile]; }
    /** Ascending. */
    std::span<const std::uint32_t> tiles(std::uint32_t share) const { return m_tiles[share]; }
    /** With the pixels within reach. */
    PixelBlock block(std::uint32_t tile, std::uint32_t reach = 0) const;

    /** Calls what(tile) for each tile within reach of the pixel. */
    template <class What> void for_each_tile_near(std::uint32_t pixel, std::uint32_t reach, What what) const {
        const std::uint32_t column = pixel % m_width, row = pixel / m_width;
        const std::uint32_t last_x = last_near(column, reach, m_width), last_y = last_near(row, reach, m_height);
        for (std::uint32_t y = first_near(row, reach); y <= last_y; ++y) {
            for (std::uint32_t x = first_near(column, reach); x <= last_x; ++x) {
                what(y * m_n_columns + x);
            }
        }
    }

private:
    std::uint32_t first_near(std::uint32_t place, std::uint32_t reach) const {
        return (place < reach ? 0 : place - reach) / m_side;
    }
    std::uint32_t last_near(std::uint32_t place, std::uint32_t reach, std::uint32_t size) const {
        return std::min(place + reach, size - 1) / m_side;
    }

    std::uint32_t m_width, m_height, m_side, m_n_columns;
    std::vector<std::uint32_t> m_owners;
    std::vector<std::vector<std::uint32_t>> m_tiles;
};

} // namespace elvis
