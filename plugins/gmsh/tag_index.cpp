#include "tag_index.hpp"

#include <algorithm>

namespace gmsh {

TagIndex::TagIndex(std::span<const std::uint64_t> tags) {
    const std::uint64_t largest = tags.empty() ? 0 : *std::ranges::max_element(tags);
    if (largest / 4 <= tags.size() + 256) {
        m_dense.assign(largest + 1, nowhere);
        for (std::size_t at = 0; at < tags.size(); ++at) {
            if (m_dense[tags[at]] != nowhere) {
                m_repeated = tags[at];
            }
            m_dense[tags[at]] = static_cast<std::uint32_t>(at);
        }
        return;
    }
    m_sorted.reserve(tags.size());
    for (std::size_t at = 0; at < tags.size(); ++at) {
        m_sorted.emplace_back(tags[at], static_cast<std::uint32_t>(at));
    }
    std::ranges::sort(m_sorted);
    const auto same_tag = [](const auto& a, const auto& b) { return a.first == b.first; };
    const auto twice = std::ranges::adjacent_find(m_sorted, same_tag);
    if (twice != m_sorted.end()) {
        m_repeated = twice->first;
    }
}

std::optional<std::uint32_t> TagIndex::find(std::uint64_t tag) const {
    if (!m_dense.empty()) {
        return tag < m_dense.size() && m_dense[tag] != nowhere ? std::optional(m_dense[tag]) : std::nullopt;
    }
    const auto found = std::ranges::lower_bound(m_sorted, tag, {}, &std::pair<std::uint64_t, std::uint32_t>::first);
    return found != m_sorted.end() && found->first == tag ? std::optional(found->second) : std::nullopt;
}

} // namespace gmsh
