// Which process puts together which pixels.
#include <core/parts/tile_parcels.hpp>
#include <core/parts/tile_shares.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace elvis;

namespace {

struct Seen {
    std::uint32_t pixel = 0;
};

bool holds(const PixelBlock& block, std::uint32_t column, std::uint32_t row) {
    return column >= block.first_column && column < block.first_column + block.width && row >= block.first_row &&
           row < block.first_row + block.height;
}

} // namespace

TEST_CASE("Each pixel has one owner, and processes have about as many as each other") {
    for (const std::uint32_t n_shares : {1u, 3u, 4u, 64u}) {
        const TileShares shares(333, 250, n_shares, 1);
        std::vector<int> n_owners(shares.n_pixels());
        std::vector<std::size_t> n_pixels(n_shares);
        for (std::uint32_t share = 0; share < n_shares; ++share) {
            for (const std::uint32_t tile : shares.tiles(share)) {
                CHECK(shares.owner(tile) == share);
                const PixelBlock block = shares.block(tile);
                n_pixels[share] += block.n_pixels();
                for (std::uint32_t pixel = 0; pixel < n_owners.size(); ++pixel) {
                    n_owners[pixel] += holds(block, pixel % 333, pixel / 333) ? 1 : 0;
                }
            }
        }
        CHECK(std::ranges::all_of(n_owners, [](int n) { return n == 1; }));
        INFO(n_shares << " shares");
        CHECK(5 * n_shares * *std::ranges::max_element(n_pixels) < 8 * shares.n_pixels());
    }
}

TEST_CASE("Owners of tiles get what parts show there and within reach, part by part") {
    constexpr std::uint32_t width = 70, height = 45, reach = 3;
    const TileShares shares(width, height, 4, reach);
    REQUIRE(shares.n_tiles() > 4);
    TileParcels<Seen> parcels(shares, reach);
    std::vector<Seen> all(std::size_t{width} * height);
    for (std::uint32_t pixel = 0; pixel < all.size(); ++pixel) {
        all[pixel].pixel = pixel;
    }
    parcels.add(5, all);
    parcels.add(7, std::span(all).first(1));
    const std::vector<std::vector<std::byte>> bytes = parcels.take();
    for (std::uint32_t share = 0; share < 4; ++share) {
        const ReceivedParcels<Seen> received({bytes[share]});
        for (const std::uint32_t tile : shares.tiles(share)) {
            const PixelBlock block = shares.block(tile, reach), own = shares.block(tile);
            CHECK((own.first_column == 0 || own.first_column - block.first_column == reach));
            std::vector<std::uint32_t> parts;
            received.for_each_part(tile, [&](std::uint32_t part, const std::vector<Seen>& items) {
                parts.push_back(part);
                CHECK((part == 7 || items.size() == block.n_pixels()));
                for (const Seen& item : items) {
                    CHECK(holds(block, item.pixel % width, item.pixel / width));
                    CHECK(block.local(item.pixel, width) < block.n_pixels());
                }
            });
            CHECK(parts == (holds(block, 0, 0) ? std::vector<std::uint32_t>{5, 7} : std::vector<std::uint32_t>{5}));
        }
    }
}
