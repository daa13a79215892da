#include <core/parts/fold_layers.hpp>
#include <core/parts/line_doubts.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ranges>
#include <utility>

namespace elvis {

namespace {

/** What a part shows of a pixel, and in which of its layers. */
struct SeenByPart {
    const PartPixel* pixel;
    LayerOfPart source;
};

/** What the picture shows of it. */
struct Crossing {
    PartPixel pixel;
    LayerOfPart source;
};

/** Of one pixel, what all parts see. */
class PixelCrossings {
public:
    explicit PixelCrossings(double tolerance) : m_tolerance(tolerance) {}

    /** Of one part the nearest first. */
    void see(const PartPixel& pixel, std::uint32_t part) {
        const std::uint32_t layer = !m_seen.empty() && m_seen.back().source.part == part ? m_seen.back().source.layer + 1 : 0;
        m_seen.push_back({&pixel, {part, layer}});
    }

    /** The nearest first. */
    std::vector<Crossing> settled() {
        std::ranges::stable_sort(m_seen, {}, [](const SeenByPart& one) { return one.pixel->depth; });
        for (const SeenByPart& one : m_seen) {
            if (one.pixel->is_own != 0) {
                keep_own(one);
            }
        }
        for (const SeenByPart& one : m_seen) {
            if (one.pixel->is_hit() && one.pixel->is_own == 0 && kept_near(one) == nullptr) {
                keep(one, pixel_flag::undecided);
            }
        }
        for (const SeenByPart& one : m_seen) {
            if (one.pixel->is_outside()) {
                keep_outside(one);
            }
        }
        std::ranges::stable_sort(m_kept, {}, [](const Crossing& one) { return one.pixel.depth; });
        return std::move(m_kept);
    }

private:
    void keep(const SeenByPart& one, std::uint32_t flags) {
        m_kept.push_back({*one.pixel, one.source});
        m_kept.back().pixel.flags |= flags;
    }

    void keep_own(const SeenByPart& one) {
        for (Crossing& other : m_kept) {
            const bool is_one_place = is_near(other.pixel, *one.pixel) && other.source.part != one.source.part;
            // Two crossings, if one of the parts sees both.
            if (is_one_place && !sees(other.source.part, *one.pixel) && !sees(one.source.part, other.pixel)) {
                other.pixel.flags |= pixel_flag::undecided;
                return;
            }
        }
        keep(one, 0);
    }

    bool is_near(const PartPixel& a, const PartPixel& b) const { return std::abs(a.depth - b.depth) <= m_tolerance; }

    bool sees(std::uint32_t part, const PartPixel& crossing) const {
        return std::ranges::any_of(m_seen, [&](const SeenByPart& one) {
            return one.source.part == part && one.pixel->element == crossing.element && is_near(*one.pixel, crossing);
        });
    }

    /** What lies in an element of one part is outside of others. */
    void keep_outside(const SeenByPart& one) {
        Crossing* const there = kept_near(one);
        if (there == nullptr) {
            keep(one, 0);
        } else if (there->pixel.is_outside()) {
            const std::uint32_t flags = settled_lines(there->pixel.flags | one.pixel->flags);
            there->pixel = is_better_outside(*one.pixel, there->pixel) ? *one.pixel : there->pixel;
            there->pixel.flags = flags;
        }
    }

    Crossing* kept_near(const SeenByPart& one) {
        const auto kept = std::ranges::find_if(m_kept, [&](const Crossing& other) { return is_near(other.pixel, *one.pixel); });
        return kept != m_kept.end() ? &*kept : nullptr;
    }

    double m_tolerance;
    std::vector<SeenByPart> m_seen;
    std::vector<Crossing> m_kept;
};

/** In front of which the picture shows so many others, of each pixel. */
Frame layer_of(const PixelBlock& block, const std::vector<std::vector<Crossing>>& crossings, std::size_t n_in_front,
               std::vector<LayerOfPart>& sources) {
    Frame layer;
    layer.flags.resize(block.n_pixels());
    layer.element.resize(block.n_pixels(), -1);
    layer.depth.resize(block.n_pixels(), std::numeric_limits<double>::quiet_NaN());
    layer.normal.resize(3 * block.n_pixels());
    sources.assign(block.n_pixels(), {});
    for (std::size_t pixel = 0; pixel < crossings.size(); ++pixel) {
        if (n_in_front < crossings[pixel].size()) {
            const Crossing& crossing = crossings[pixel][n_in_front];
            layer.flags[pixel] = crossing.pixel.flags;
            layer.element[pixel] = crossing.pixel.element;
            layer.depth[pixel] = crossing.pixel.depth;
            std::ranges::copy(crossing.pixel.normal, &layer.normal[3 * pixel]);
            sources[pixel] = crossing.pixel.is_hit() ? crossing.source : LayerOfPart{};
        }
    }
    return layer;
}

void flag_open_lines(const LineDoubts& doubts, const PixelBlock& block, std::vector<std::vector<Crossing>>& crossings) {
    std::size_t n_layers = 0;
    for (const std::vector<Crossing>& pixel : crossings) {
        n_layers = std::max(n_layers, pixel.size());
    }
    std::vector<LayerOfPart> sources;
    for (std::size_t n_in_front = 0; doubts.are_possible() && n_in_front < n_layers; ++n_in_front) {
        Frame layer = layer_of(block, crossings, n_in_front, sources);
        doubts.flag(sources, layer);
        for (std::size_t pixel = 0; pixel < crossings.size(); ++pixel) {
            if (n_in_front < crossings[pixel].size()) {
                crossings[pixel][n_in_front].pixel.flags = layer.flags[pixel];
            }
        }
    }
}

/** What of the block is kept, as that counts pixels. */
FoldedLayers layers_in(const PixelBlock& block, const PixelBlock& kept, const std::vector<std::vector<Crossing>>& crossings,
                       const std::vector<std::uint32_t>& doubts) {
    FoldedLayers layers;
    for (std::uint32_t row = 0; row < kept.height; ++row) {
        for (std::uint32_t column = 0; column < kept.width; ++column) {
            const std::size_t pixel = std::size_t{kept.first_row - block.first_row + row} * block.width + kept.first_column -
                                      block.first_column + column;
            for (const Crossing& crossing : crossings[pixel]) {
                layers.crossings.push_back(crossing.pixel);
                layers.crossings.back().pixel = row * kept.width + column;
            }
            layers.doubts.push_back(doubts[pixel]);
        }
    }
    return layers;
}

} // namespace

FoldedLayers folded_layers(const FrameRequest& request, const PixelBlock& block, const PixelBlock& kept,
                           std::span<const PartPixels> parts, double diagonal) {
    std::vector<PixelCrossings> seen(block.n_pixels(), PixelCrossings(same_depth * diagonal));
    std::vector<std::uint32_t> doubts(block.n_pixels(), 0);
    for (const PartPixels& one : parts) {
        for (const PartPixel& pixel : one.pixels) {
            doubts[pixel.pixel] |= doubts_of(pixel);
            if (pixel.is_hit() || pixel.is_outside()) {
                seen[pixel.pixel].see(pixel, one.part);
            }
        }
    }
    std::vector<std::vector<Crossing>> crossings;
    std::ranges::transform(seen, std::back_inserter(crossings), [](PixelCrossings& pixel) { return pixel.settled(); });
    flag_open_lines(LineDoubts(request, block, parts), block, crossings);
    return layers_in(block, kept, crossings, doubts);
}

FoldedLayers one_layer(const Frame& surface) {
    FoldedLayers layer;
    layer.doubts = surface.flags;
    for (std::size_t pixel = 0; pixel < surface.flags.size(); ++pixel) {
        if (!std::isnan(surface.depth[pixel])) {
            PartPixel& crossing = layer.crossings.emplace_back();
            crossing.pixel = static_cast<std::uint32_t>(pixel);
            crossing.flags = std::exchange(layer.doubts[pixel], 0);
            crossing.element = surface.element[pixel];
            crossing.value = surface.value[pixel];
            crossing.depth = surface.depth[pixel];
            std::copy_n(&surface.normal[3 * pixel], 3, crossing.normal.begin());
            std::copy_n(&surface.color[4 * pixel], 4, crossing.color.begin());
        }
    }
    return layer;
}

LayerStack::LayerStack(const Frame& opaque) : m_opaque_depths(opaque.depth) {
    constexpr double behind_everything = std::numeric_limits<double>::infinity();
    std::ranges::replace_if(
        m_opaque_depths, [](double depth) { return std::isnan(depth); }, behind_everything);
}

void LayerStack::add(const FoldedLayers& surface, Frame& picture) {
    for (std::size_t pixel = 0; pixel < surface.doubts.size(); ++pixel) {
        picture.flags[pixel] = merged_flags(picture.flags[pixel], surface.doubts[pixel], false, false);
    }
    for (const PartPixel& crossing : surface.crossings) {
        const std::size_t pixel = crossing.pixel;
        const bool is_nearest = std::isnan(picture.depth[pixel]) || crossing.depth < picture.depth[pixel];
        const bool is_hidden = !is_nearest && crossing.depth >= m_opaque_depths[pixel];
        const std::uint32_t behind = is_nearest ? picture.flags[pixel] : is_hidden ? 0 : crossing.flags;
        picture.flags[pixel] = merged_flags(picture.flags[pixel], crossing.flags, true, is_nearest) | doubt_behind(behind);
        if (is_nearest) {
            picture.element[pixel] = crossing.element;
            picture.value[pixel] = crossing.value;
            picture.depth[pixel] = crossing.depth;
            std::ranges::copy(crossing.normal, &picture.normal[3 * pixel]);
        }
    }
    m_crossings.insert(m_crossings.end(), surface.crossings.begin(), surface.crossings.end());
}

std::vector<PartPixel> LayerStack::seen() const {
    std::vector<PartPixel> seen;
    std::ranges::copy_if(m_crossings, std::back_inserter(seen),
                         [&](const PartPixel& crossing) { return crossing.depth < m_opaque_depths[crossing.pixel]; });
    std::ranges::stable_sort(seen, {}, [](const PartPixel& crossing) { return std::pair(crossing.pixel, crossing.depth); });
    return seen;
}

void LayerStack::blend(Frame& picture) const {
    const std::vector<PartPixel> nearest_first = seen();
    for (const PartPixel& crossing : nearest_first | std::views::reverse) {
        double* const under = &picture.color[4 * std::size_t{crossing.pixel}];
        const double over = crossing.color[3], alpha = over + under[3] * (1 - over), share = alpha > 0 ? over / alpha : 0;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            under[channel] += share * (crossing.color[channel] - under[channel]);
        }
        under[3] = alpha;
    }
}

std::vector<LightRun> LayerStack::stops() const {
    std::vector<LightRun> stops;
    for (const PartPixel& crossing : seen()) {
        const bool is_first = stops.empty() || stops.back().pixel != crossing.pixel;
        LightRun& stop = stops.emplace_back();
        stop.pixel = crossing.pixel;
        stop.n_stops = static_cast<std::uint16_t>(is_first ? 0 : stops[stops.size() - 2].n_stops + 1);
        stop.first = stop.end = crossing.depth;
        stop.red = crossing.color[3] * crossing.color[0];
        stop.green = crossing.color[3] * crossing.color[1];
        stop.blue = crossing.color[3] * crossing.color[2];
        stop.transmittance = 1 - crossing.color[3];
    }
    return stops;
}

} // namespace elvis
