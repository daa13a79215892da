#include <core/parts/fold_layers.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

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
            if (one.pixel->is_own == 0 && !is_kept_near(one)) {
                keep(one, pixel_flag::undecided);
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

    bool is_kept_near(const SeenByPart& one) const {
        return std::ranges::any_of(m_kept, [&](const Kept& kept) { return is_near(kept.pixel, *one.pixel); });
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
            if (pixel.is_hit()) {
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

void LayerStack::blend(Frame& picture) const {
    std::vector<PartPixel> farthest_first = m_crossings;
    // Of two at the same depth the surface that comes first is in front.
    std::ranges::reverse(farthest_first);
    std::ranges::stable_sort(farthest_first, std::greater{}, &PartPixel::depth);
    for (const PartPixel& crossing : farthest_first) {
        if (crossing.depth < m_opaque_depths[crossing.pixel]) {
            double* const under = &picture.color[4 * std::size_t{crossing.pixel}];
            const double over = crossing.color[3], alpha = over + under[3] * (1 - over), share = alpha > 0 ? over / alpha : 0;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                under[channel] += share * (crossing.color[channel] - under[channel]);
            }
            under[3] = alpha;
        }
    }
}

} // namespace elvis
