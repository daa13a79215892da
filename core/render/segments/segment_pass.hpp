/**
 * @file segment_pass.hpp
 * The segments of rays, front to back.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/frame.hpp>
#include <core/render/segments/walk_search.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/segments/walk_data.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

/**
 * origin + t * direction for t in [from, to], relative to DeviceVolume::centre(). On the device the numbers have the precision
 * in use: near_centre() makes rays that are exact in it.
 */
struct SegmentRay {
    Vector3 origin{}, direction{};
    double from = -1e30, to = 1e30;
};

/** The ray through these points of the world, from `eye` on; its origin is the point nearest to the centre, t counts from
 * there. */
SegmentRay near_centre(const Vector3& eye, const Vector3& towards, const std::array<double, 3>& centre, Precision precision);

struct Segment {
    double enter = 0, leave = 0;
    /** Bound of the error of both but for rare cases, rounding included. */
    double error = 0;
    /** In the volume's order. */
    std::uint64_t element = 0;
    /** Its ends do not rest on a known curvature of the element, or of the one before, whose end is its beginning. */
    bool is_estimated = false;
};

/** Of one ray. */
struct SegmentList {
    std::vector<Segment> segments;
    /** Somewhere it could not be told where the ray enters or leaves an element: segments may be missing. */
    bool is_undecided = false;
};

struct SegmentCounts {
    std::uint64_t segments = 0;
    /** Of the mapping, to walk through elements and to find where they begin. */
    std::uint64_t evaluations = 0, seek_evaluations = 0;
    /** Elements that others hide in part, elements of which the way out could not be found, segments that are estimates. */
    std::uint64_t overlaps = 0, failures = 0, estimated = 0;
    /** Where a face did not tell the next element. */
    std::uint64_t breaks = 0;
    /** Rays that were given up, and those of which segments may be missing. */
    std::uint64_t given_up = 0, undecided = 0;
    double milliseconds = 0;
};

/** The kernels of one volume, for each element class, and for rays that are given or those of a picture. */
class SegmentPass {
public:
    /**
     * `data` with a field selected must outlive it. With `skipped`, the first component of a field at a time step, elements are
     * passed over that surely lack the values wanted.
     */
    struct SkippedField {
        std::uint32_t field = 0, time_step = 0;
    };
    SegmentPass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                const std::optional<SkippedField>& skipped = {});

    /** The segments of each ray. `wanted`: least and greatest value; only of a pass that skips. */
    std::vector<SegmentList> lists(std::span<const SegmentRay> rays, SegmentCounts& counts,
                                   const std::array<double, 2>& wanted = {-3e38, 3e38});

    /**
     * For each pixel of a picture, by rows, the sum of the lengths of its ray's segments, along the axis of view; no lists are
     * made. `view`: the geometry of any plane, of which only the rays matter.
     */
    std::vector<double> lengths(const CutPlaneGeometry& view, const ViewStart& start, std::uint32_t width, std::uint32_t height,
                                SegmentCounts& counts);

private:
    struct Kernels {
        explicit Kernels(WalkSearch starts) : search(std::move(starts)) {}

        WalkSearch search;
        /** By the search's ranges of elements. */
        std::vector<std::unique_ptr<ComposedKernel>> march;
    };
    struct Rays;
    /** Compiled when first needed. */
    Kernels& kernels_for(bool are_given);
    template <class Take> void run(Kernels& kernels, const Rays& rays, SegmentCounts& counts, const Take& take) const;
    template <class Real> void list_batch(std::span<const SegmentRay> rays, SegmentList* lists, SegmentCounts& counts);
    std::vector<std::vector<bool>> elements_with(const std::array<double, 2>& wanted) const;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    const DeviceVolume& m_data;
    Precision m_precision;
    std::optional<SkippedField> m_skipped;
    WalkData m_walk_data;
    /** Of rays of pixels, and of rays that are given. */
    std::array<std::optional<Kernels>, 2> m_kernels;
    Buffer m_frame, m_counts;
};

} // namespace elvis
