#include <core/render/device/late_counts.hpp>

namespace elvis {

void LateCounts::begin() { m_entries.clear(); }

void LateCounts::add(const Buffer& from, std::size_t n_words, Take take) {
    const std::size_t first = m_entries.empty() ? 0 : m_entries.back().first + m_entries.back().count;
    if (!m_device.collects_submissions() || first + n_words > most_words) {
        take(from.read_items<std::uint32_t>(n_words));
        return;
    }
    const VkBufferCopy region{0, first * sizeof(std::uint32_t), n_words * sizeof(std::uint32_t)};
    m_device.record([&](VkCommandBuffer commands) { vkCmdCopyBuffer(commands, from.handle(), m_kept.handle(), 1, &region); });
    m_entries.push_back({first, n_words, std::move(take)});
}

Buffer::Read LateCounts::read() {
    m_words.resize(m_entries.empty() ? 0 : m_entries.back().first + m_entries.back().count);
    return {&m_kept, std::as_writable_bytes(std::span(m_words))};
}

void LateCounts::take_all() {
    for (const Entry& entry : m_entries) {
        entry.take(std::span(m_words).subspan(entry.first, entry.count));
    }
    m_entries.clear();
}

} // namespace elvis
