/**
 * @file face_pass.hpp
 * Draws faces of elements into the samples of a picture: the boundary, or the elements of a two-dimensional volume.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/render/tiles/tile_list.hpp>
#include <core/volume/boundary/face_set.hpp>
#include <core/volume/device_volume.hpp>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/** The kernels of one volume and field, for each element class. Most are compiled when constructed. */
class FacePass {
public:
    /** `faces` must outlive it, too. */
    FacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, const FaceSet& faces);

    /**
     * Draws the faces; each class is a surface of its own, numbered from `first_surface`. `view` is the geometry of any plane:
     * only its rays matter. With `target.beyond`, the nearest crossings behind those depths by more than rounding.
     */
    void draw(const CutPlaneGeometry& view, std::uint32_t first_surface, const ShownComponent& component,
              const LayerTarget& target, FrameCounts& counts);

private:
    /** Tiles of pixels; those that many faces may touch; pixels near silhouettes. */
    enum class Draws { pixels, deep_pixels, careful };
    struct ClassKernels {
        std::unique_ptr<ComposedKernel> tiles;
        /** Compiled when first needed. */
        std::array<std::unique_ptr<ComposedKernel>, 3> drawing;
        KernelRequest request;
        std::uint32_t element_class = 0;

        const ComposedKernel& provide(const Device& device, Draws what);
    };

    const Device& m_device;
    Precision m_precision;
    std::uint32_t m_tile_width, m_tile_height;
    std::vector<ClassKernels> m_kernels;
    TileList m_listed;
    Buffer m_frame;
    Buffer m_counts;
    /** Kept from frame to frame. */
    std::optional<Buffer> m_tiles, m_list;
};

} // namespace elvis
