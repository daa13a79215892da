/**
 * @file surface_pass.hpp
 * Draws cut surfaces given by formulas or files into the samples of a picture.
 *
 * Round by round: the next crossing of each pixel's ray with the surface (surface_hits), then the element that holds it, for
 * each element class (surface_tiles, surface_pixels). Pixels whose crossing lies in no element go on to the next round.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/cut_surface/open_points.hpp>
#include <core/render/cut_surface/other_values.hpp>
#include <core/render/cut_surface/outside_pass.hpp>
#include <core/render/cut_surface/surface_solver.hpp>
#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/render/tiles/tile_list.hpp>
#include <core/volume/device_volume.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/** The kernels of one volume and field that find elements, two for each element class. */
class SurfacePass {
public:
    SurfacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** Compiles what finds the elements of crossings: before draw(), unless the solver has values of its own. */
    void provide_elements();

    /**
     * Draws one surface, whose solver this is, as number `surface`, at least 1; adds to the counts. `view` is the geometry of
     * any plane of the picture: only its rays matter.
     */
    void draw(const CutPlaneGeometry& view, const SurfaceSolver& solver, const CutShape& shape, std::uint32_t surface,
              const ShownComponent& component, bool shows_outside, const LayerTarget& target, FrameCounts& counts);

    /**
     * A number for each pixel that shows the surface drawn last: an upper bound of the surface's normal curvatures there,
     * without sign; 3e38 where none is known.
     */
    const Buffer& bending() const { return *m_bending; }

private:
    struct ClassKernels {
        std::uint32_t element_class;
        std::unique_ptr<ComposedKernel> tiles;
        std::unique_ptr<ComposedKernel> pixels;
    };
    struct Picture;
    std::uint32_t find_hits(const Picture& picture, std::uint32_t round) const;
    void draw_pixels(const ClassKernels& kernels, const Picture& picture, FrameCounts& counts);
    void draw_outside(const Picture& picture);
    void provide_buffers(std::uint64_t n_pixels, std::uint64_t n_tiles, std::uint32_t boxes_a_tile);

    const Device& m_device;
    const RuntimeVolume& m_volume;
    const DeviceVolume& m_data;
    Precision m_precision;
    std::vector<ClassKernels> m_kernels;
    TileList m_listed;
    Buffer m_frame;
    Buffer m_hit_counts;
    Buffer m_counts;
    /** Stands where a buffer is not used. */
    Buffer m_nothing;
    OtherValues m_others;
    OpenPoints m_open;
    std::unique_ptr<OutsidePass> m_outside;
    std::optional<Buffer> m_hits, m_bending, m_boxes, m_tiles;
};

} // namespace elvis
