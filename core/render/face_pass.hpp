/**
 * @file face_pass.hpp
 * Draws faces of elements into the samples of a picture: the boundary, or the elements of a two-dimensional volume.
 */
#pragma once

#include <core/render/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/layer.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/face_set.hpp>

#include <memory>
#include <vector>

namespace elvis {

/** The kernels of one volume and field, one for each element class. Compiled when constructed. */
class FacePass {
public:
    /** `faces`: null for the elements of a two-dimensional volume. */
    FacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, const FaceSet* faces);

    /**
     * Draws the faces; each class is a surface of its own, numbered from `first_surface`. `view` is the geometry of any plane: only its rays matter.
     */
    void draw(const CutPlaneGeometry& view, std::uint32_t first_surface, const ShownComponent& component,
              const LayerTarget& target, FrameCounts& counts);

private:
    Precision m_precision;
    std::vector<std::unique_ptr<ComposedKernel>> m_kernels;
    Buffer m_frame;
    Buffer m_counts;
};

} // namespace elvis
