/**
 * @file line_pass.hpp
 * Lines on curved surfaces: on layers that other passes have drawn.
 */
#pragma once

#include <core/render/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/layer.hpp>
#include <core/render/line_request.hpp>
#include <core/volume/device_volume.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/** The kernels of one volume and field, one for each element class. Compiled when constructed. */
class LinePass {
public:
    /** On faces of elements, or on surfaces that cut them. `data` must have derivative bounds. */
    LinePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, bool on_faces);

    /**
     * Flags the pixels of a layer that meet lines. `view`: the geometry of any plane: only its rays matter. `bending`: a number
     * a pixel, as SurfacePass::bending(); null on faces.
     */
    void draw(const CutPlaneGeometry& view, const ShownComponent& component, const LineRequest& lines, const Buffer* bending,
              const LayerTarget& target, FrameCounts& counts);

private:
    const Device& m_device;
    Precision m_precision;
    std::vector<std::unique_ptr<ComposedKernel>> m_kernels;
    Buffer m_frame;
    Buffer m_counts;
    std::optional<Buffer> m_isovalues;
};

} // namespace elvis
