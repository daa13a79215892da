#include <core/parts/tile_shares.hpp>

#include <algorithm>
#include <numeric>

namespace elvis {

namespace {

constexpr std::uint32_t smallest_side = 8, largest_side = 128;
/** Of a process: so many that what it has is about as much as what others have. */
constexpr std::uint64_t tiles_a_share = 64;
/** Sides in reaches: what is around a tile is then no more than half of what it holds. */
constexpr std::uint32_t sides_of_reach = 8;

std::uint32_t count_tiles(std::uint32_t size, std::uint32_t side) { return (size + side - 1) / side; }

std::uint32_t side_for(std::uint32_t width, std::uint32_t height, std::uint32_t n_shares, std::uint32_t reach) {
    std::uint32_t side = largest_side;
    while (side > smallest_side && side / 2 >= sides_of_reach * reach &&
           std::uint64_t{count_tiles(width, side)} * count_tiles(height, side) < tiles_a_share * n_shares) {
        side /= 2;
    }
    return std::max(side, sides_of_reach * reach);
}

/** Bits of both numbers in turn. */
std::uint64_t morton_code(std::uint32_t column, std::uint32_t row) {
    std::uint64_t code = 0;
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
        code |= std::uint64_t{column >> bit & 1} << (2 * bit) | std::uint64_t{row >> bit & 1} << (2 * bit + 1);
    }
    return code;
}

} // namespace

TileShares::TileShares(std::uint32_t width, std::uint32_t height, std::uint32_t n_shares, std::uint32_t most_reach)
    : m_width(width), m_height(height), m_side(side_for(width, height, n_shares, most_reach)),
      m_n_columns(count_tiles(width, m_side)), m_owners(std::size_t{m_n_columns} * count_tiles(height, m_side)),
      m_tiles(n_shares) {
    std::vector<std::uint32_t> along(m_owners.size());
    std::iota(along.begin(), along.end(), 0u);
    std::ranges::sort(along, {}, [&](std::uint32_t tile) { return morton_code(tile % m_n_columns, tile / m_n_columns); });
    for (std::size_t place = 0; place < along.size(); ++place) {
        m_owners[along[place]] = static_cast<std::uint32_t>(place % n_shares);
    }
    for (std::uint32_t tile = 0; tile < m_owners.size(); ++tile) {
        m_tiles[m_owners[tile]].push_back(tile);
    }
}

PixelBlock TileShares::block(std::uint32_t tile, std::uint32_t reach) const {
    const std::uint32_t column = tile % m_n_columns * m_side, row = tile / m_n_columns * m_side;
    PixelBlock block;
    block.first_column = column - std::min(column, reach);
    block.first_row = row - std::min(row, reach);
    block.width = std::min(m_width, column + m_side + reach) - block.first_column;
    block.height = std::min(m_height, row + m_side + reach) - block.first_row;
    return block;
}

} // namespace elvis
