/**
 * @file isosurface_pass.hpp
 * Draws isosurfaces into the samples of a picture.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/isosurface/isosurface_projection.hpp>
#include <core/render/picture/layer.hpp>
#include <core/render/tiles/tile_list.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/isosurface/isovalue_set.hpp>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

/** The kernels of one volume and of the field whose isosurfaces are drawn, for each element class. */
class IsosurfacePass {
public:
    /** `data` has that field selected, and its derivative bounds. Kernels are compiled when first needed, most by choose(). */
    IsosurfacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** What the next pictures show; the field lacks `offset` on the device. See IsovalueSet::choose. */
    void choose(const Isosurfaces& wanted, std::uint32_t time_step, double offset, const ShownComponent& component);

    /**
     * Draws the nearest crossing of each ray; each class is a surface of its own, numbered from `first_surface`. Samples get
     * the isovalue, less the offset; `target` has places. `view` is the geometry of any plane: only its rays matter. What lies
     * well below one of the planes `clip` (ax + by + cz + d < 0) is not looked for.
     */
    void draw(const CutPlaneGeometry& view, std::span<const std::array<double, 4>> clip, std::uint32_t first_surface,
              const LayerTarget& target, FrameCounts& counts);

    /** An upper bound of the normal curvatures of what was drawn last, a number a pixel. */
    const Buffer& bending() const { return *m_bending; }
    /** The rays of what was drawn last, as kernels read them (view.glsl). */
    const Buffer& frame() const { return m_frame; }

private:
    /** Lists for tiles of pixels; tiles whose lists hold leaves only; tiles that many elements may touch; chosen pixels of any.
     */
    enum class Role { tiles, pixels, deep_pixels, chosen_pixels, n_roles };
    /** Rows of pixels that an invocation draws: they share the iterations that drivers grant. */
    static std::uint32_t rows_of(const Device& device, Role role);
    struct ClassKernels {
        /** What they have in common. */
        KernelRequest request;
        /** What intervals are looked for in, and projection. */
        std::vector<FetchBuffer> octants, elements;
        /** IsovalueSet::room(), for which kernels are composed. */
        std::uint64_t room = 0;
        std::uint32_t element_class = 0;
        /** Kept from frame to frame: tiles with their octants, and which of them see something. */
        std::optional<Buffer> tiles;
        std::optional<TileList> listed;
        /** By role, and whether there is one isovalue. Compiled when first needed. */
        std::array<std::array<std::unique_ptr<ComposedKernel>, 2>, static_cast<std::size_t>(Role::n_roles)> kernels;

        const ComposedKernel& provide(const Device& device, Role role, bool has_one_isovalue);
        /** Drops kernels that were composed with less room. */
        void follow_room(const IsovalueSet& set);
    };

    /** The isovalues, and the planes relative to the reference point of the rays. */
    void write_isovalues(const CutPlaneGeometry& view, std::span<const std::array<double, 4>> clip);
    std::vector<TileList::Ranges> list_tiles(const Layer& layer, const TileRows& wanted);
    /** `mask`: not zero in pixels that are drawn; all are without it. */
    void draw_by_intervals(std::uint32_t first_surface, const LayerTarget& target, const Buffer* mask, FrameCounts& counts);
    /** Pixels that carry one of these flags, or rest on estimates, afresh. */
    void draw_again_by_intervals(std::uint32_t left_open, std::uint32_t first_surface, const LayerTarget& target,
                                 FrameCounts& counts);
    /** Pixels that carry one of these flags, afresh; all if there are none. */
    void draw_by_projection(IsosurfaceMethod method, std::uint32_t flags, std::uint32_t first_surface,
                            const LayerTarget& target, FrameCounts& counts);

    const Device& m_device;
    Precision m_precision;
    std::uint32_t m_tile_width;
    /** The diagonal of the volume's bounds. */
    float m_extent;
    IsovalueSet m_isovalue_set;
    /** Less the offset. */
    std::vector<double> m_values;
    std::uint32_t m_n_clips = 0;
    ScalarComponent m_component;
    IsosurfaceMethod m_method = IsosurfaceMethod::interval;
    std::uint32_t m_degree = 0;
    std::vector<ClassKernels> m_kernels;
    IsosurfaceProjection m_projection;
    Buffer m_frame;
    Buffer m_counts;
    /** And behind them the planes that clip. */
    std::optional<Buffer> m_isovalues;
    /** Kept from frame to frame. */
    std::optional<Buffer> m_bending, m_mask;
    /** What each round tells the next one of the crossings that it found (shaders/isosurface/isosurface_bindings.glsl). */
    std::optional<Buffer> m_last;
    std::uint32_t m_round = 0;
};

} // namespace elvis
