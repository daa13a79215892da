/**
 * @file tile_parcels.hpp
 * What parts show, on its way to the processes that put together the pixels.
 */
#pragma once

#include <core/parts/tile_shares.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace elvis {

/** Of one part in one tile. */
struct ParcelHead {
    std::uint32_t tile = 0, part = 0;
    std::uint64_t n_items = 0;
};

/** To be sent: by process the parcels of its tiles. An item is of one pixel: Item::pixel, a number in the whole picture. */
template <class Item> class TileParcels {
    static_assert(std::is_trivially_copyable_v<Item>);

public:
    /** `reach`: pixels around a tile that its owner must know. */
    TileParcels(const TileShares& shares, std::uint32_t reach)
        : m_shares(shares), m_reach(reach), m_items(shares.n_tiles()), m_bytes(shares.n_shares()) {}

    /** Of one part after the other, in their order. */
    void add(std::uint32_t part, std::span<const Item> items) {
        for (const Item& item : items) {
            m_shares.for_each_tile_near(item.pixel, m_reach, [&](std::uint32_t tile) { m_items[tile].push_back(item); });
        }
        for (std::uint32_t tile = 0; tile < m_items.size(); ++tile) {
            if (!m_items[tile].empty()) {
                std::vector<std::byte>& bytes = m_bytes[m_shares.owner(tile)];
                const ParcelHead head{tile, part, m_items[tile].size()};
                put(std::as_bytes(std::span(&head, 1)), bytes);
                put(std::as_bytes(std::span(m_items[tile])), bytes);
                m_items[tile] = {};
            }
        }
    }

    std::vector<std::vector<std::byte>> take() { return std::move(m_bytes); }

private:
    static void put(std::span<const std::byte> from, std::vector<std::byte>& bytes) {
        bytes.insert(bytes.end(), from.begin(), from.end());
    }

    const TileShares& m_shares;
    std::uint32_t m_reach;
    /** By tile. */
    std::vector<std::vector<Item>> m_items;
    std::vector<std::vector<std::byte>> m_bytes;
};

/** Received: by tile what the parts show there. */
template <class Item> class ReceivedParcels {
public:
    /** `of_ranks`: in the order of ranks, who have parts in their order. */
    explicit ReceivedParcels(std::vector<std::vector<std::byte>> of_ranks) : m_of_ranks(std::move(of_ranks)) {
        for (const std::vector<std::byte>& bytes : m_of_ranks) {
            for (std::size_t at = 0; at < bytes.size();) {
                Parcel parcel{};
                std::memcpy(&parcel.head, bytes.data() + at, sizeof parcel.head);
                parcel.items = bytes.data() + at + sizeof parcel.head;
                at += sizeof parcel.head + parcel.head.n_items * sizeof(Item);
                m_parcels.push_back(parcel);
                m_n_items += parcel.head.n_items;
            }
        }
        std::ranges::stable_sort(m_parcels, {}, [](const Parcel& parcel) { return parcel.head.tile; });
    }

    std::uint64_t n_items() const { return m_n_items; }
    std::uint64_t n_bytes() const { return m_n_items * sizeof(Item) + m_parcels.size() * sizeof(ParcelHead); }

    /** Calls take(part, items) for each part that shows something in the tile, in their order. */
    template <class Take> void for_each_part(std::uint32_t tile, Take take) const {
        const auto found = std::ranges::equal_range(m_parcels, tile, {}, [](const Parcel& parcel) { return parcel.head.tile; });
        for (const Parcel& parcel : found) {
            std::vector<Item> items(parcel.head.n_items);
            std::memcpy(items.data(), parcel.items, items.size() * sizeof(Item));
            take(parcel.head.part, std::move(items));
        }
    }

private:
    struct Parcel {
        ParcelHead head;
        const std::byte* items;
    };

    std::vector<std::vector<std::byte>> m_of_ranks;
    std::vector<Parcel> m_parcels;
    std::uint64_t m_n_items = 0;
};

} // namespace elvis
