#include <core/parts/shared_fold.hpp>

#include <core/base/milliseconds.hpp>
#include <core/parts/collect_tiles.hpp>
#include <core/parts/line_doubts.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace elvis {

namespace {

constexpr double infinitely_far = std::numeric_limits<double>::infinity();

std::uint64_t bytes_in(const std::vector<std::vector<std::byte>>& messages) {
    return std::accumulate(messages.begin(), messages.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const std::vector<std::byte>& one) { return sum + one.size(); });
}

std::vector<Frame> facts_in(const std::vector<std::vector<std::byte>>& of_ranks) {
    std::vector<Frame> facts;
    for (const std::vector<std::byte>& bytes : of_ranks) {
        std::ranges::move(unpacked_facts(bytes), std::back_inserter(facts));
    }
    return facts;
}

/** Of what parts show in a tile, with pixels as the block counts them. */
template <class Part, class Item>
std::vector<Part> parts_in(const ReceivedParcels<Item>& received, std::uint32_t tile, const PixelBlock& block,
                           std::uint32_t width, std::vector<Item> Part::*items) {
    std::vector<Part> parts;
    received.for_each_part(tile, [&](std::uint32_t part, std::vector<Item> found) {
        for (Item& item : found) {
            item.pixel = block.local(item.pixel, width);
        }
        Part& one = parts.emplace_back();
        one.part = part;
        one.*items = std::move(found);
    });
    return parts;
}

} // namespace

SharedFold::SharedFold(const FrameRequest& request, Precision precision, double diagonal, Team& team)
    : m_request(request), m_precision(precision), m_diagonal(diagonal), m_team(team),
      m_shares(request.width, request.height, team.size(), reach_of_fold(request)) {}

SharedFrame SharedFold::empty() const {
    SharedFrame picture;
    for (const std::uint32_t tile : m_shares.tiles(m_team.rank())) {
        picture.tiles.push_back(empty_block(m_request, m_shares.block(tile), m_precision));
    }
    picture.facts = empty_facts(m_request);
    return picture;
}

/** What parts show of a surface in own tiles; and facts of own parts. */
ReceivedParcels<PartPixel> SharedFold::exchanged(const DrawParts& draw, std::uint32_t reach, std::vector<std::byte>& facts) {
    TileParcels<PartPixel> parcels(m_shares, reach);
    draw([&](const PartPicture& picture) {
        parcels.add(picture.part, picture.pixels);
        pack_facts(picture.facts, facts);
    });
    std::vector<std::vector<std::byte>> sent = parcels.take();
    m_work.sent_bytes += bytes_in(sent);
    ReceivedParcels<PartPixel> received(m_team.exchanged(std::move(sent)));
    m_work.received_bytes += received.n_bytes();
    return received;
}

SharedFrame SharedFold::surface(const FrameRequest& alone, const DrawParts& draw) {
    const std::uint32_t reach = reach_of_fold(alone);
    std::vector<std::byte> facts;
    const ReceivedParcels<PartPixel> received = exchanged(draw, reach, facts);
    SharedFrame surface;
    for (const std::uint32_t tile : m_shares.tiles(m_team.rank())) {
        const PixelBlock block = m_shares.block(tile, reach);
        const auto parts = parts_in(received, tile, block, m_request.width, &PartPixels::pixels);
        surface.tiles.push_back(folded(alone, block, m_shares.block(tile), parts, m_diagonal, m_precision));
    }
    surface.facts = folded_facts(alone, facts_in(m_team.gathered(std::move(facts))));
    return surface;
}

void SharedFold::add_layers(const FrameRequest& alone, const DrawParts& draw, std::size_t index, SharedFrame& picture) {
    const bool is_met_once = meets_rays_once(alone.surfaces[0]);
    const std::uint32_t reach = reach_of_fold(alone);
    std::vector<std::byte> facts;
    const ReceivedParcels<PartPixel> received = exchanged(draw, reach, facts);
    if (picture.layers.empty()) {
        for (const Frame& tile : picture.tiles) {
            picture.layers.emplace_back(tile);
        }
    }
    const auto tiles = m_shares.tiles(m_team.rank());
    for (std::size_t k = 0; k < tiles.size(); ++k) {
        const PixelBlock block = m_shares.block(tiles[k], reach);
        const auto parts = parts_in(received, tiles[k], block, m_request.width, &PartPixels::pixels);
        const PixelBlock kept = m_shares.block(tiles[k]);
        picture.layers[k].add(is_met_once ? one_layer(folded(alone, block, kept, parts, m_diagonal, m_precision))
                                          : folded_layers(alone, block, kept, parts, m_diagonal),
                              picture.tiles[k]);
    }
    add_surface_facts(folded_facts(alone, facts_in(m_team.gathered(std::move(facts)))), index, picture.facts);
}

void SharedFold::add(const SharedFrame& surface, std::size_t index, SharedFrame& picture) const {
    for (std::size_t tile = 0; tile < picture.tiles.size(); ++tile) {
        add_surface(surface.tiles[tile], picture.tiles[tile]);
    }
    add_surface_facts(surface.facts, index, picture.facts);
}

void SharedFold::finish_surfaces(SharedFrame& picture) const {
    for (std::size_t k = 0; k < picture.layers.size() && !m_request.volume; ++k) {
        picture.layers[k].blend(picture.tiles[k]);
    }
    std::ranges::for_each(picture.tiles, [](Frame& tile) { elvis::finish_surfaces(tile); });
}

std::vector<double> SharedFold::depths(const SharedFrame& picture) const {
    if (m_request.surfaces.empty()) {
        return std::vector<double>(std::size_t{m_request.width} * m_request.height, infinitely_far);
    }
    std::vector<std::vector<double>> of_tiles;
    for (std::size_t k = 0; k < picture.tiles.size(); ++k) {
        of_tiles.push_back(picture.layers.empty() ? picture.tiles[k].depth : picture.layers[k].opaque_depths());
    }
    std::vector<double> depths = collected_numbers(m_shares, of_tiles, m_team);
    std::ranges::replace_if(
        depths, [](double depth) { return std::isnan(depth); }, infinitely_far);
    return m_team.of_first(std::move(depths));
}

std::vector<std::vector<double>> SharedFold::stops(const SharedFrame& picture) const {
    // By own tile, then stop.
    std::vector<std::vector<std::vector<double>>> of_tiles;
    double minus_most = 0;
    for (const LayerStack& layers : picture.layers) {
        std::vector<std::vector<double>>& depths = of_tiles.emplace_back();
        for (const LightRun& stop : layers.stops()) {
            if (stop.n_stops == depths.size()) {
                depths.emplace_back(layers.opaque_depths().size(), infinitely_far);
            }
            depths[stop.n_stops][stop.pixel] = stop.first;
        }
        minus_most = std::min(minus_most, -static_cast<double>(depths.size()));
    }
    m_team.minimum(std::span(&minus_most, 1));
    std::vector<std::vector<double>> all(static_cast<std::size_t>(-minus_most));
    for (std::size_t stop = 0; stop < all.size(); ++stop) {
        std::vector<std::vector<double>> own;
        for (const std::vector<std::vector<double>>& depths : of_tiles) {
            own.push_back(stop < depths.size() ? depths[stop] : std::vector<double>{});
            own.back().resize(picture.layers[own.size() - 1].opaque_depths().size(), infinitely_far);
        }
        all[stop] = m_team.of_first(collected_numbers(m_shares, own, m_team));
    }
    return all;
}

void SharedFold::add_light(const DrawParts& draw, SharedFrame& picture) {
    TileParcels<LightRun> parcels(m_shares, 0);
    std::vector<std::byte> facts;
    // The largest, as the smallest of what is below zero.
    double below_zero = 0;
    draw([&](const PartPicture& part) {
        parcels.add(part.part, part.facts.runs);
        pack_facts(part.facts, facts);
        below_zero = std::min(below_zero, -part.facts.color_error);
    });
    m_team.minimum(std::span(&below_zero, 1));
    std::vector<std::vector<std::byte>> sent = parcels.take();
    m_work.sent_bytes += bytes_in(sent);
    const ReceivedParcels<LightRun> received(m_team.exchanged(std::move(sent)));
    m_work.received_bytes += received.n_bytes();
    m_work.n_runs = received.n_items();
    const auto start = std::chrono::steady_clock::now();
    const LightRule rule{m_request.volume->tolerance, -below_zero, m_diagonal};
    const auto tiles = m_shares.tiles(m_team.rank());
    for (std::size_t index = 0; index < tiles.size(); ++index) {
        const PixelBlock block = m_shares.block(tiles[index]);
        const auto parts = parts_in(received, tiles[index], block, m_request.width, &PartRuns::runs);
        const std::vector<LightRun> stops = picture.layers.empty() ? std::vector<LightRun>{} : picture.layers[index].stops();
        m_work.n_lit_pixels += elvis::add_light(rule, parts, stops, picture.tiles[index]);
    }
    m_work.milliseconds = milliseconds_since(start);
    for (const Frame& part : facts_in(m_team.gathered(std::move(facts)))) {
        add_work(part, picture.facts);
    }
}

Frame SharedFold::collected(SharedFrame picture, bool with_buffers) const {
    return collected_frame(m_shares, m_request, m_precision, std::move(picture), with_buffers, m_team);
}

} // namespace elvis
