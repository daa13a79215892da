#include <core/render/device/provide_buffer.hpp>
#include <core/render/tiles/tile_list.hpp>

#include <vector>

namespace elvis {

namespace {

/** In front of the tiles, the numbers of both ranges: shaders/tiles/list_tile.glsl. */
constexpr std::uint32_t n_header_words = 2;

} // namespace

const Buffer& TileList::begin(std::uint32_t n_tiles) {
    const std::uint64_t bytes = (std::uint64_t{n_header_words} + n_tiles) * sizeof(std::uint32_t);
    m_n_tiles = n_tiles;
    Buffer& buffer = provide_buffer(m_buffer, m_device, bytes);
    buffer.fill(0);
    return buffer;
}

TileList::Ranges TileList::read() const {
    const std::vector<std::uint32_t> header = m_buffer->read_items<std::uint32_t>(n_header_words);
    return {{n_header_words, header[0]}, {n_header_words + m_n_tiles - header[1], header[1]}};
}

} // namespace elvis
