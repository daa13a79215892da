#include <core/parts/fold_layers.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ranges>
#include <utility>

namespace elvis {

namespace {

/** What a part shows of a pixel. */
struct SeenByPart {
    const PartPixel* pixel;
    std::uint32_t part;
};

/** Of one pixel, what all parts see. */
class PixelCrossings {
public:
    explicit PixelCrossings(double tolerance) : m_tolerance(tolerance) {}

    void see(const PartPixel& pixel, std::uint32_t part) { m_seen.push_back({&pixel, part}); }

    /** The nearest first. */
    std::vector<PartPixel> settled() {
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
        std::vector<PartPixel> crossings;
        std::ranges::stable_sort(m_kept, {}, [](const Kept& one) { return one.pixel.depth; });
        for (const Kept& one : m_kept) {
            crossings.push_back(one.pixel);
        }
        return crossings;
    }

private:
    struct Kept {
        PartPixel pixel;
        std::uint32_t part;
    };

    void keep(const SeenByPart& one, std::uint32_t flags) {
        m_kept.push_back({*one.pixel, one.part});
        m_kept.back().pixel.flags |= flags;
    }

    void keep_own(const SeenByPart& one) {
        for (Kept& other : m_kept) {
            const bool is_one_place = is_near(other.pixel, *one.pixel) && other.part != one.part;
            // Two crossings, if one of the parts sees both.
            if (is_one_place && !sees(other.part, *one.pixel) && !sees(one.part, other.pixel)) {
                other.pixel.flags |= pixel_flag::undecided;
                return;
            }
        }
        keep(one, 0);
    }

    bool is_near(const PartPixel& a, const PartPixel& b) const { return std::abs(a.depth - b.depth) <= m_tolerance; }

    bool sees(std::uint32_t part, const PartPixel& crossing) const {
        return std::ranges::any_of(m_seen, [&](const SeenByPart& one) {
            return one.part == part && one.pixel->element == crossing.element && is_near(*one.pixel, crossing);
        });
    }

    /** What lies in an element of one part is outside of others. */
    void keep_outside(const SeenByPart& one) {
        Kept* const there = kept_near(one);
        if (there == nullptr) {
            keep(one, 0);
        } else if (there->pixel.is_outside()) {
            there->pixel.flags |= one.pixel->flags;
        }
    }

    Kept* kept_near(const SeenByPart& one) {
        const auto kept = std::ranges::find_if(m_kept, [&](const Kept& other) { return is_near(other.pixel, *one.pixel); });
        return kept != m_kept.end() ? &*kept : nullptr;
    }

    double m_tolerance;
    std::vector<SeenByPart> m_seen;
    std::vector<Kept> m_kept;
};

} // namespace

FoldedLayers folded_layers(std::size_t n_pixels, std::span<const PartPixels> parts, double diagonal) {
    std::vector<PixelCrossings> seen(n_pixels, PixelCrossings(same_depth * diagonal));
    FoldedLayers folded;
    folded.doubts.resize(n_pixels);
    for (const PartPixels& one : parts) {
        for (const PartPixel& pixel : one.pixels) {
            folded.doubts[pixel.pixel] |= doubts_of(pixel);
            if (pixel.is_hit() || pixel.is_outside()) {
                seen[pixel.pixel].see(pixel, one.part);
            }
        }
    }
    for (PixelCrossings& pixel : seen) {
        const std::vector<PartPixel> crossings = pixel.settled();
        folded.crossings.insert(folded.crossings.end(), crossings.begin(), crossings.end());
    }
    return folded;
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
        picture.flags[pixel] = merged_flags(picture.flags[pixel], crossing.flags, true, is_nearest);
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
