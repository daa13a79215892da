/**
 * @file cut_plane_pass.hpp
 * Draws cut planes into the samples of a picture.
 */
#pragma once

#include <core/render/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/layer.hpp>
#include <core/volume/device_volume.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/** The kernels of one volume and field, two for each element class. Compiled when constructed. */
class CutPlanePass {
public:
    CutPlanePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** Draws one plane as surface number `surface`, at least 1; adds to the counts. */
    void draw(const CutPlaneGeometry& geometry, std::uint32_t surface, const ShownComponent& component,
              const LayerTarget& target, FrameCounts& counts);

private:
    struct ClassKernels {
        /** Which nodes of the hierarchy each tile of pixels can touch; then the pixels. */
        std::unique_ptr<ComposedKernel> tiles;
        std::unique_ptr<ComposedKernel> pixels;
    };

    const Device& m_device;
    Precision m_precision;
    std::uint32_t m_tile_width;
    std::vector<ClassKernels> m_kernels;
    Buffer m_frame;
    Buffer m_counts;
    std::optional<Buffer> m_tiles;
};

} // namespace elvis
