/**
 * @file line_pass.hpp
 * Lines on surfaces other than planes: on layers that other passes have drawn.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/lines/line_request.hpp>
#include <core/render/picture/layer.hpp>
#include <core/volume/boundary/face_set.hpp>
#include <core/volume/device_volume.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/** The kernels of one volume and field, for each element class. */
class LinePass {
public:
    /**
     * On these faces, which must outlive it, or on shapes of one solver (SurfaceSolver::quadric_rows). `data` must have
     * derivative bounds. `is_whole_boundary`: they are all without neighbour. `on_own_boundary`: on where elements are cut,
     * as if they were whole, since they end there.
     */
    LinePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, const FaceSet* faces,
             bool is_whole_boundary, std::uint32_t quadric_rows, bool on_own_boundary = false);

    /** Compiles what lines with or without contours need. */
    void provide(bool with_contours);

    /**
     * Flags the pixels of a layer that meet lines. `view`: the geometry of any plane: only its rays matter. `target` has
     * places. `bending`: a number a pixel, as SurfacePass::bending(), and `shape`: SurfaceSolver::rows(), both null on faces.
     */
    void draw(const CutPlaneGeometry& view, const ShownComponent& component, const LineRequest& lines, const Buffer* bending,
              const Buffer* shape, const LayerTarget& target, FrameCounts& counts);

private:
    struct ClassKernels {
        std::uint32_t element_class = 0;
        /** What the element that a pixel shows tells; a closer look; what is seen at silhouettes, on faces and quadrics. */
        std::unique_ptr<ComposedKernel> settle, search, exclude;
    };
    std::vector<ClassKernels> compile(bool with_contours) const;
    std::uint32_t n_of(std::size_t which) const { return m_counts.read_items<std::uint32_t>(n_counts)[which]; }
    struct Picture;
    struct Listed;
    /** Which of the kernels takes the listed pixels, with how many halvings. */
    struct Round {
        std::unique_ptr<ComposedKernel> ClassKernels::*kernel;
        std::uint32_t subdivisions;
    };
    void settle(const Picture& picture) const;
    std::vector<Round> rounds_to(std::uint32_t subdivisions) const;
    void look_closer(const Picture& picture, std::uint32_t n_listed, bool is_closed);
    void look_closer(const Picture& picture, const Round& round, const Listed& listed) const;

    /** Evaluations, listed pixels, and those that each round leaves open. */
    static constexpr std::size_t n_counts = 40;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    const DeviceVolume& m_data;
    const FaceSet* m_faces;
    /** What of it faces away is never seen. */
    bool m_is_closed;
    std::uint32_t m_quadric_rows;
    bool m_on_own_boundary;
    std::uint32_t m_tile_width;
    /** Without contours, with them. */
    std::array<std::vector<ClassKernels>, 2> m_kernels;
    Buffer m_frame;
    Buffer m_counts;
    std::optional<Buffer> m_isovalues;
    /** Pixels that need a closer look, those that stay open after it, and after one more. */
    std::optional<Buffer> m_list, m_open, m_still_open;
};

} // namespace elvis
