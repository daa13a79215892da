/**
 * @file color_pass.hpp
 * Samples of a surface to colours: colour map, lines, clipping, opacity.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/render/picture/line_stretches_pass.hpp>
#include <core/shader/composer.hpp>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace elvis {

class ColorPass {
public:
    ColorPass(const Device& device, Precision precision);

    /** Before the surfaces of a picture. */
    void begin(std::size_t n_surfaces);

    /**
     * Colours the layer of the surface with this index in the picture. Its field lacks `offset` on the device. `background`:
     * colour where the surface is not seen; its opacity must be 0 for a layer that is to be merged. `common_flags` are set on
     * every pixel that is hit. `view`: the geometry of any plane: only its rays matter, and its normal if the surface is a
     * plane. `lighting`: of this surface; null for none. `shades`: of a surface with line integral convolution.
     */
    void draw(const Layer& layer, const Surface& surface, std::size_t index, const CutPlaneGeometry& view,
              const Color& background, double offset, std::uint32_t common_flags, const Lighting* lighting,
              const Buffer* shades = nullptr);

    /** The kernel for surfaces like this one; compiled when it is first asked for. */
    const ComposedKernel& provide(const Surface& surface, bool is_lit);

    /** What the kernels have noted of the surfaces drawn since begin(), and what that means. */
    const Buffer& special() const { return *m_special; }
    std::vector<SpecialValues> special_values(std::span<const std::uint32_t> words) const;

private:
    const Device& m_device;
    Precision m_precision;
    /** With and without lines, wide ones, light, planes that clip, and shades: what a picture does not need costs it nothing.
     */
    std::map<std::array<bool, 5>, std::unique_ptr<ComposedKernel>> m_kernels;
    /** Once it is needed. */
    std::unique_ptr<LineStretchesPass> m_stretches_pass;
    Buffer m_frame;
    std::unique_ptr<Buffer> m_special;
    std::size_t m_n_surfaces = 0;
};

} // namespace elvis
