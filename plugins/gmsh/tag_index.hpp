/**
 * @file tag_index.hpp
 * From the tags of a file, which may be sparse and in any order, to positions.
 */
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gmsh {

class TagIndex {
public:
    TagIndex() = default;
    explicit TagIndex(std::span<const std::uint64_t> tags);

    /** A tag that occurs more than once, if there is one. */
    std::optional<std::uint64_t> repeated() const { return m_repeated; }
    /** Position of a tag among those given. */
    std::optional<std::uint32_t> find(std::uint64_t tag) const;

private:
    static constexpr std::uint32_t nowhere = 0xffffffff;

    std::optional<std::uint64_t> m_repeated;
    /** By tag, where tags are dense; else empty. */
    std::vector<std::uint32_t> m_dense;
    /** In order of the tag. */
    std::vector<std::pair<std::uint64_t, std::uint32_t>> m_sorted;
};

} // namespace gmsh
