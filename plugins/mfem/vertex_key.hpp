/**
 * @file vertex_key.hpp
 * Edges and faces as keys of hash tables.
 */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace elvis_mfem {

/** Sorted vertices of an edge or face; unused places are -1. */
using VertexKey = std::array<std::int32_t, 4>;

struct VertexKeyHash {
    std::size_t operator()(const VertexKey& key) const {
        // Multipliers of splitmix64 and MurmurHash3, which spread neighbouring numbers.
        std::uint64_t hash = 0x9e3779b97f4a7c15u;
        for (std::int32_t vertex : key) {
            hash = (hash ^ static_cast<std::uint32_t>(vertex)) * 0xff51afd7ed558ccdu;
            hash ^= hash >> 32;
        }
        return static_cast<std::size_t>(hash);
    }
};

} // namespace elvis_mfem
