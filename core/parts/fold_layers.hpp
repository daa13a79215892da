/**
 * @file fold_layers.hpp
 * Surfaces that can be seen through, from what parts show of them.
 */
#pragma once

#include <core/parts/fold.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Where the rays of a block meet one such surface. */
struct FoldedLayers {
    /** By pixel, the nearest first. */
    std::vector<PartPixel> crossings;
    /** Flags of each pixel besides. */
    std::vector<std::uint32_t> doubts;
};

/**
 * Of what parts show, the nearest first in each pixel, all that they own. Where two parts each own what may be one crossing, or
 * where none owns what others see, rounding decides: it is there once, and flagged as undecided (256). Outside of elements the
 * surface lies where no part has an element. `request`, `block`, `kept`, `diagonal`: as of folded(). Lines are flagged as
 * there, by what is seen of the surface for the first time, the second time and so on.
 */
FoldedLayers folded_layers(const FrameRequest& request, const PixelBlock& block, const PixelBlock& kept,
                           std::span<const PartPixels> parts, double diagonal);
/** Of a surface that rays meet once: its pixels (folded()). */
FoldedLayers one_layer(const Frame& surface);

/** Such surfaces of a block, until all are there. */
class LayerStack {
public:
    /** Over these opaque surfaces: all there are. */
    explicit LayerStack(const Frame& opaque);

    /** Values, depths and flags go into the picture at once. */
    void add(const FoldedLayers& surface, Frame& picture);
    /** Colours do when all surfaces are added, as shaders/picture/blend.comp mixes them. */
    void blend(Frame& picture) const;
    /** Instead, where there is light of the volume, too: as runs of it (add_light), by pixel, the nearest first. */
    std::vector<LightRun> stops() const;
    /** Of opaque surfaces; infinite where there is none. */
    const std::vector<double>& opaque_depths() const { return m_opaque_depths; }

private:
    /** By pixel, the nearest first; of two at the same depth the surface that comes first is in front. */
    std::vector<PartPixel> seen() const;

    std::vector<double> m_opaque_depths;
    /** In the order of surfaces. */
    std::vector<PartPixel> m_crossings;
};

} // namespace elvis
