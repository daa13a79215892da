/**
 * @file merge_pass.hpp
 * Layers of surfaces into one picture: the nearest opaque one, and over it the transparent ones in order.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>

#include <memory>
#include <span>
#include <vector>

namespace elvis {

/** Colours and depths of a transparent layer, CORE_FAR where it is not seen. */
struct TransparentLayer {
    Buffer colors, depths;
};

/** Depths as the device has them: CORE_FAR where they are infinite. */
std::vector<double> device_depths(std::span<const double> depths);

class MergePass {
public:
    MergePass(const Device& device, Precision precision);

    /** Starts an empty picture of this size, in which layers have something in these rows only. */
    void begin(std::uint32_t width, std::uint32_t height, const PixelRows& rows, const Color& background);

    /** Pixels that want to see what of a surface is behind, how many they are and between which rows. */
    struct Wanted {
        std::uint32_t n_pixels = 0, first_row = 0, end_row = 0;
    };

    /** Merges the coloured layer of surface number `surface`, counted from 1. beyond() tells where what is wanted is. */
    Wanted merge(const Layer& layer, std::uint32_t surface, bool has_normals, bool is_see_through);

    /** Depths behind which the layer merged last is wanted, one real a pixel; null if nothing was merged. */
    const Buffer* beyond() const { return m_beyond.get(); }

    /** Puts the transparent layers over the picture. */
    void finish();

    /** Colours of the background, if nothing was merged. */
    void fill_empty();
    /** Instead of merging: opaque surfaces that are not drawn lie at these depths, one a pixel, infinite where there is none.
     */
    void hide_behind(std::span<const double> depths);
    /** Depth of the nearest opaque surface, one real a pixel, CORE_FAR where there is none; null if nothing was merged. */
    const Buffer* depths() const { return m_is_empty ? nullptr : m_depths.get(); }
    /** Transparent layers; in each pixel they are in order, the nearest first. */
    std::size_t n_transparent_layers() const { return m_n_transparent_layers; }
    const TransparentLayer& transparent_layer(std::size_t i) const { return m_transparent_layers[i]; }

    const Layer& picture() const { return *m_picture; }

private:
    void keep(const Layer& layer);

    const Device& m_device;
    Precision m_precision;
    ComposedKernel m_merge, m_take, m_order, m_blend, m_fill;
    std::unique_ptr<Layer> m_picture;
    std::unique_ptr<Buffer> m_depths, m_beyond;
    Buffer m_counts, m_background_color;
    /** Kept from frame to frame; the first m_n_transparent_layers are in use. */
    std::vector<TransparentLayer> m_transparent_layers;
    std::size_t m_n_transparent_layers = 0;
    bool m_is_empty = true;
};

} // namespace elvis
