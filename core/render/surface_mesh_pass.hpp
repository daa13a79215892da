/**
 * @file surface_mesh_pass.hpp
 * Draws the elements of a two-dimensional volume into the samples of a picture.
 */
#pragma once

#include <core/render/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/samples.hpp>
#include <core/volume/device_volume.hpp>

#include <memory>
#include <vector>

namespace elvis {

/** The kernels of one volume and field, one for each element class. Compiled when constructed. */
class SurfaceMeshPass {
public:
    SurfaceMeshPass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /**
     * Draws the elements; each class is a surface of its own, numbered from `first_surface`. `normals` receives three numbers a
     * pixel (unit, towards the viewer) where an element is seen. `view` is the geometry of any plane: only its rays matter.
     */
    void draw(const CutPlaneGeometry& view, std::uint32_t first_surface, const ShownComponent& component,
              const SampleTarget& target, const Buffer& normals, FrameCounts& counts);

private:
    Precision m_precision;
    std::vector<std::unique_ptr<ComposedKernel>> m_kernels;
    Buffer m_frame;
    Buffer m_counts;
};

} // namespace elvis
