/**
 * @file volume_pass.hpp
 * Draws the volume itself: light emitted and absorbed along rays.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/render/picture/merge_pass.hpp>
#include <core/render/segments/walk_search.hpp>
#include <core/render/volume/light_runs.hpp>
#include <core/render/volume/live_rays.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/isosurface/linear_models.hpp>
#include <core/volume/segments/walk_data.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace elvis {

/** Of one core_volume_state. */
inline std::size_t volume_state_bytes(Precision precision) { return 10 * real_bytes(precision) + 4 * sizeof(std::uint32_t); }

/** The kernels of one volume and of the field that the transfer function is of, for each element class. */
class VolumePass {
public:
    /** `data` has that field selected, and its derivative bounds. Kernels are compiled when first needed, most by choose(). */
    VolumePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** What the next pictures show; the field lacks `offset` on the device. */
    void choose(const VolumeRendering& wanted, double offset, const ShownComponent& component);

    /**
     * Draws in front of the opaque surfaces of a picture, and between its transparent ones, which are not put over it before.
     * `view` is the geometry of any plane: only its rays matter. `only_live`: not where no ray has anything to do.
     */
    void draw(const CutPlaneGeometry& view, const ViewStart& start, const MergePass& merged, bool only_live,
              FrameCounts& counts);

    /**
     * The same light in runs (core/render/volume/light_run.hpp), by pixel and along each ray, without color_error(). `stops`:
     * FrameRequest::stops.
     */
    std::vector<LightRun> runs(const CutPlaneGeometry& view, const ViewStart& start, const MergePass& merged,
                               std::span<const std::vector<double>> stops, bool only_live, FrameCounts& counts);
    /** What each channel of a ray's light is off because colours have few breakpoints. */
    double color_error() const { return m_color_error; }

private:
    struct Picture;
    Picture begin(const CutPlaneGeometry& view, const ViewStart& start, const MergePass& merged, bool only_live,
                  double color_error, FrameCounts& counts);
    /** `index`: among the search's ranges of elements. */
    const ComposedKernel& march_kernel(std::size_t index);
    void march(std::size_t index, const Picture& picture, const RayGroups& groups);
    bool count(FrameCounts& counts) const;
    void march_all(const Picture& picture, FrameCounts& counts);

    const Device& m_device;
    const RuntimeVolume& m_volume;
    const DeviceVolume& m_data;
    Precision m_precision;
    WalkData m_walk_data;
    WalkSearch m_search;
    LinearModels m_models;
    ComposedKernel m_begin, m_transparent_layer, m_finish;
    LiveRays m_live;
    Buffer m_frame, m_counts;
    /** By the search's ranges; by integrator, and whether the transfer function has jumps. */
    std::vector<std::map<std::pair<Integrator, bool>, ComposedKernel>> m_march;
    VolumeRendering m_wanted;
    ShownComponent m_component;
    std::uint32_t m_n_breakpoints = 0;
    double m_steepest = 0;
    /** What colours are off because they have few breakpoints. */
    double m_color_error = 0;
    bool m_has_jumps = false;
    std::optional<Buffer> m_breakpoints, m_pieces;
    /** Kept from frame to frame. */
    std::optional<Buffer> m_states;
    /** Of the stop that rays go to. */
    std::optional<Buffer> m_stops;
    /** Made when first wanted: few pictures do. */
    std::optional<LightRuns> m_runs;
};

} // namespace elvis
