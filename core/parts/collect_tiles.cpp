#include <core/parts/collect_tiles.hpp>

#include <core/parts/fold.hpp>
#include <core/render/picture/count_pixels.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

namespace elvis {

namespace {

/** In flags, without buffers: whether the pixel shows a surface. */
constexpr std::uint32_t hit_bit = std::uint32_t{1} << 31;

template <class T> void put_numbers(const std::vector<T>& numbers, std::vector<std::byte>& bytes) {
    const auto raw = std::as_bytes(std::span(numbers));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

/** Numbers of a block's pixels, `n` each, into those of the whole picture. */
template <class T>
void take_numbers(std::span<const std::byte>& bytes, const PixelBlock& block, std::uint32_t width, std::size_t n,
                  std::vector<T>& all) {
    const std::size_t row_bytes = block.width * n * sizeof(T);
    assert(bytes.size() >= block.height * row_bytes);
    for (std::uint32_t row = 0; row < block.height; ++row) {
        const std::size_t place = std::size_t{block.first_row + row} * width + block.first_column;
        std::memcpy(all.data() + place * n, bytes.data(), row_bytes);
        bytes = bytes.subspan(row_bytes);
    }
}

bool shows_nothing(const Frame& tile, const Frame& empty) {
    return tile.color == empty.color && std::ranges::all_of(tile.element, [](std::int64_t number) { return number < 0; }) &&
           std::ranges::all_of(tile.flags, [](std::uint32_t flags) { return flags == 0; });
}

void mark_hits(Frame& tile) {
    for (std::size_t pixel = 0; pixel < tile.flags.size(); ++pixel) {
        tile.flags[pixel] |= std::isnan(tile.depth[pixel]) ? 0 : hit_bit;
    }
}

void pack_tile(Frame tile, bool with_buffers, std::vector<std::byte>& bytes) {
    put_numbers(tile.color, bytes);
    if (with_buffers) {
        put_numbers(tile.value, bytes);
        put_numbers(tile.depth, bytes);
        put_numbers(tile.normal, bytes);
        put_numbers(tile.element, bytes);
    } else {
        mark_hits(tile);
    }
    put_numbers(tile.flags, bytes);
}

void unpack_tile(std::span<const std::byte>& bytes, const PixelBlock& block, bool with_buffers, Frame& whole) {
    take_numbers(bytes, block, whole.width, 4, whole.color);
    if (with_buffers) {
        take_numbers(bytes, block, whole.width, 1, whole.value);
        take_numbers(bytes, block, whole.width, 1, whole.depth);
        take_numbers(bytes, block, whole.width, 3, whole.normal);
        take_numbers(bytes, block, whole.width, 1, whole.element);
    }
    take_numbers(bytes, block, whole.width, 1, whole.flags);
}

/** What mark_hits has told. */
void unmark_hits(Frame& whole) {
    for (std::size_t pixel = 0; pixel < whole.flags.size(); ++pixel) {
        whole.element[pixel] = (whole.flags[pixel] & hit_bit) != 0 ? 0 : -1;
        whole.flags[pixel] &= ~hit_bit;
    }
}

/** Which of the tiles follow, then those. */
std::vector<std::byte> packed_tiles(const TileShares& shares, const FrameRequest& request, Precision precision,
                                    std::vector<Frame> tiles, bool with_buffers, std::uint32_t rank) {
    std::vector<std::byte> bytes(tiles.size());
    for (std::size_t index = 0; index < tiles.size(); ++index) {
        Frame tile = std::exchange(tiles[index], {});
        if (!shows_nothing(tile, empty_block(request, shares.block(shares.tiles(rank)[index]), precision))) {
            bytes[index] = std::byte{1};
            pack_tile(std::move(tile), with_buffers, bytes);
        }
    }
    return bytes;
}

Frame unpacked_tiles(const TileShares& shares, const FrameRequest& request, Precision precision,
                     std::vector<std::vector<std::byte>> of_ranks, bool with_buffers) {
    Frame whole = empty_block(request, {0, 0, request.width, request.height}, precision);
    for (std::uint32_t rank = 0; rank < of_ranks.size(); ++rank) {
        const std::vector<std::byte> bytes = std::move(of_ranks[rank]);
        const auto tiles = shares.tiles(rank);
        std::span<const std::byte> left = std::span(bytes).subspan(tiles.size());
        for (std::size_t index = 0; index < tiles.size(); ++index) {
            if (bytes[index] != std::byte{0}) {
                unpack_tile(left, shares.block(tiles[index]), with_buffers, whole);
            }
        }
    }
    if (!with_buffers) {
        unmark_hits(whole);
    }
    return whole;
}

void drop_buffers(Frame& frame) {
    frame.value = frame.depth = frame.normal = {};
    frame.element = {};
}

} // namespace

std::vector<double> collected_numbers(const TileShares& shares, std::span<const std::vector<double>> of_tiles, Team& team) {
    std::vector<std::byte> own;
    for (const std::vector<double>& tile : of_tiles) {
        put_numbers(tile, own);
    }
    const std::vector<std::vector<std::byte>> of_ranks = team.gathered(std::move(own));
    std::vector<double> numbers;
    for (std::uint32_t rank = 0; rank < of_ranks.size(); ++rank) {
        numbers.resize(shares.n_pixels());
        std::span<const std::byte> left = of_ranks[rank];
        for (const std::uint32_t tile : shares.tiles(rank)) {
            take_numbers(left, shares.block(tile), shares.width(), 1, numbers);
        }
    }
    return numbers;
}

Frame collected_frame(const TileShares& shares, const FrameRequest& request, Precision precision, SharedFrame picture,
                      bool with_buffers, Team& team) {
    std::vector<std::vector<std::byte>> of_ranks =
        team.gathered(packed_tiles(shares, request, precision, std::move(picture.tiles), with_buffers, team.rank()));
    if (!team.is_first()) {
        return {};
    }
    Frame whole = unpacked_tiles(shares, request, precision, std::move(of_ranks), with_buffers);
    Frame& facts = picture.facts;
    whole.counts = facts.counts;
    whole.special_values = std::move(facts.special_values);
    whole.is_met = std::move(facts.is_met);
    whole.render_milliseconds = facts.render_milliseconds;
    whole.device_milliseconds = facts.device_milliseconds;
    whole.submissions = facts.submissions;
    whole.host_waits = facts.host_waits;
    count_pixels(whole);
    if (!with_buffers) {
        drop_buffers(whole);
    }
    return whole;
}

} // namespace elvis
