#include <core/render/device/provide_buffer.hpp>
#include <core/render/tiles/tile_list.hpp>

#include <vector>

namespace elvis {

const Buffer& TileList::begin(std::uint32_t n_tiles) {
    const std::uint64_t bytes = (std::uint64_t{n_header_words} + n_tiles) * sizeof(std::uint32_t);
    m_n_tiles = n_tiles;
    Buffer& buffer = provide_buffer(m_buffer, m_device, bytes);
    buffer.fill(0);
    return buffer;
}

TileList::Ranges TileList::read() const {
    const std::vector<std::uint32_t> header = m_buffer->read_items<std::uint32_t>(n_header_words);
    return ranges(std::span(header).first<n_header_words>());
}

TileList::Ranges TileList::ranges(std::span<const std::uint32_t, n_header_words> header) const {
    // In front of the tiles, the numbers of both ranges: shaders/tiles/list_tile.glsl.
    return {{n_header_words, header[0]}, {static_cast<std::uint32_t>(n_header_words) + m_n_tiles - header[1], header[1]}};
}

bool TileList::is_indirect() const {
    return m_device.collects_submissions() && m_n_tiles <= m_device.limits().maxComputeWorkGroupCount[0];
}

const Buffer& TileList::groups(std::uint32_t groups_y) {
    const VkDispatchIndirectCommand size{0, groups_y, 1};
    const Buffer& groups = provide_buffer(m_groups, m_device, sizeof size);
    groups.write_items(std::span(&size, 1));
    const VkBufferCopy region{0, 0, sizeof(std::uint32_t)};
    m_device.record(
        [&](VkCommandBuffer commands) { vkCmdCopyBuffer(commands, m_buffer->handle(), groups.handle(), 1, &region); });
    return groups;
}

} // namespace elvis
