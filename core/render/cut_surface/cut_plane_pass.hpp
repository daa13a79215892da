/**
 * @file cut_plane_pass.hpp
 * Draws cut planes into layers, with lines on them if wanted.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/cut_surface/open_points.hpp>
#include <core/render/cut_surface/other_values.hpp>
#include <core/render/cut_surface/outside_pass.hpp>
#include <core/render/frame.hpp>
#include <core/render/lines/line_request.hpp>
#include <core/render/picture/layer.hpp>
#include <core/render/tiles/tile_list.hpp>
#include <core/volume/device_volume.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/** Changes a kernel that evaluates elements of a class, before it is compiled: for measurements. */
using KernelEdit = std::function<void(KernelRequest& request, std::uint32_t element_class)>;

/** The kernels of one volume and field, for each element class. Compiled when constructed. */
class CutPlanePass {
public:
    /** With lines, `data` must have derivative bounds. */
    CutPlanePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, bool with_lines,
                 const KernelEdit& edit = {});

    /** Draws one plane as surface number `surface`, at least 1; adds to the counts. `lines`: only of a pass made with them. */
    void draw(const CutPlaneGeometry& geometry, std::uint32_t surface, const ShownComponent& component,
              const LineRequest& lines, const LayerTarget& target, FrameCounts& counts);
    /** Lines on what was drawn last. */
    void draw_lines(const ShownComponent& component, const LineRequest& lines, const LayerTarget& target, FrameCounts& counts);
    /** Where what was drawn last lies in no element, near the volume. */
    void draw_outside(const CutPlaneGeometry& geometry, std::uint32_t surface, const LayerTarget& target);

private:
    struct ClassKernels {
        std::uint32_t element_class;
        /** Which nodes of the hierarchy each tile of pixels can touch; then the pixels. */
        std::unique_ptr<ComposedKernel> tiles;
        std::unique_ptr<ComposedKernel> pixels;
        /** What needs a closer look for lines. */
        std::unique_ptr<ComposedKernel> lines;
        std::optional<Buffer> tile_nodes;
    };

    void compile(const RuntimeVolume& volume, const DeviceVolume& data, const KernelEdit& edit);
    void draw_pixels(ClassKernels& kernels, std::uint32_t surface, const ShownComponent& component, std::uint32_t n_isovalues,
                     const LayerTarget& target, FrameCounts& counts);
    void draw_lines(const ClassKernels& kernels, const ShownComponent& component, const LineRequest& lines,
                    const LayerTarget& target, FrameCounts& counts);

    const Device& m_device;
    const DeviceVolume& m_data;
    Precision m_precision;
    bool m_with_lines;
    std::uint32_t m_tile_width, m_tile_height;
    std::vector<ClassKernels> m_kernels;
    std::optional<ComposedKernel> m_list_pixels;
    TileList m_listed;
    Buffer m_frame;
    Buffer m_counts;
    std::optional<Buffer> m_isovalues;
    std::optional<Buffer> m_list;
    OtherValues m_others;
    OpenPoints m_open;
    std::unique_ptr<OutsidePass> m_outside;
};

} // namespace elvis
