/**
 * @file surface_solver.hpp
 * Finds where the rays of a picture meet one surface.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/shader/composer.hpp>
#include <core/surface/shape_frame.hpp>

#include <memory>
#include <optional>
#include <span>

namespace elvis {

/** Of the tiles of pixels that the kernels of surfaces work on. */
inline constexpr std::uint32_t surface_tile_height = 16;

/** The same for shapes that one solver serves, in one volume. */
std::string solver_key(const CutShape& shape);

/**
 * The kernel of one kind of surface and what it reads: good for all shapes with the same solver_key(). Compiled when
 * constructed; independent of the field.
 */
class SurfaceSolver {
public:
    /** `bounds`: of the volume, min x y z, max x y z. */
    SurfaceSolver(const Device& device, Precision precision, const CutShape& shape, const std::array<double, 6>& bounds);

    /** Boxes of a tile that the kernel writes, one below the other. */
    std::uint32_t boxes_a_tile() const { return surface_tile_height / m_hit_rows; }

    /**
     * Prepares a picture of a shape with the solver's key. `bounds`: min x y z, max x y z; crossings are looked for in this
     * box. `most_error`: error of a crossing along the ray, in world length, from which on its pixel is undecided.
     * `ends_in_box`: the box ends what is seen of the shape.
     */
    void begin(const CutShape& shape, const CutPlaneGeometry& view, const std::array<double, 6>& bounds, double most_error,
               bool ends_in_box = false) const;

    /** What begin() wrote. */
    const Buffer& rows() const { return *m_rows; }
    /** Number of rows of a quadric without ends (shaders/surface/quadric.glsl); 0 of other shapes. */
    std::uint32_t quadric_rows() const { return m_is_quadric ? m_n_rows : 0; }

    /** What it finds has values and elements of its own, which it writes into samples and marks (SurfaceTraits). */
    bool has_own_values() const { return m_numbers != nullptr; }

    /**
     * Looks for the crossings of some rows of tiles. `buffers`: bindings 2 to 8 of surface/hits.comp, and 9, the
     * samples, if has_own_values().
     */
    void find(const Buffer& frame, std::span<const Buffer* const> buffers, std::span<const std::byte> parameters,
              std::uint32_t tiles_a_row, std::uint32_t tile_rows) const;

private:
    void upload(const TriangleMesh& mesh, const Vector3& middle);
    void upload(const PatchMesh& mesh, const Vector3& middle);
    void upload(const TubeSet& tubes, const Vector3& middle);
    void upload(const RibbonSet& ribbons, const Vector3& middle);
    void upload(const ArrowSet& set, const Vector3& middle);
    void upload_nodes(std::span<const double> boxes, const Vector3& middle);

    const Device& m_device;
    Precision m_precision;
    /** Held so that another file's data never have the same address, which solver_key() names. */
    std::shared_ptr<const void> m_mesh;
    /** Triangles, patches or the like, and the hierarchy over them; of arrows, their elements. */
    std::unique_ptr<RecordBuffer> m_items, m_nodes, m_numbers;
    /** What coordinates of functions are relative to. */
    Vector3 m_origin{};
    std::uint32_t m_hit_rows = surface_tile_height;
    std::uint32_t m_n_rows = 0;
    bool m_is_quadric = false;
    std::optional<Buffer> m_rows;
    std::unique_ptr<ComposedKernel> m_kernel;
};

/** As surface/hits.comp reads them. */
struct HitsParameters {
    std::uint32_t width, height;
    std::uint32_t first_tile_row;
    std::uint32_t surface;
    std::uint32_t round;
    std::uint32_t has_beyond;
    std::uint32_t with_whole_pixels;
};

} // namespace elvis
