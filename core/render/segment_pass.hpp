/**
 * @file segment_pass.hpp
 * The segments of rays: their parts inside of elements, front to back.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/element_links.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

/**
 * origin + t * direction for t in [from, to], relative to DeviceVolume::centre(). On the device the numbers have the precision in
 * use: near_centre() makes rays that are exact in it.
 */
struct SegmentRay {
    Vector3 origin{}, direction{};
    double from = -1e30, to = 1e30;
};

/** The ray through these points of the world, from `eye` on; its origin is the point nearest to the centre, t counts from there. */
SegmentRay near_centre(const Vector3& eye, const Vector3& towards, const std::array<double, 3>& centre, Precision precision);

struct Segment {
    double enter = 0, leave = 0;
    /** Bound of the error of both but for rare cases, rounding included. */
    double error = 0;
    /** In the volume's order. */
    std::uint64_t element = 0;
    /** Its ends do not rest on a known curvature of the element. */
    bool is_estimated = false;
};

struct SegmentCounts {
    std::uint64_t segments = 0, evaluations = 0;
    /** Parts of elements that others hide, parts that could not be found, segments that are estimates. */
    std::uint64_t overlaps = 0, failures = 0, estimated = 0;
    /** Turns of all invocations; dispatches. */
    std::uint64_t turns = 0, dispatches = 0;
    /** Chains of neighbours that had to be taken up again by the hierarchy. */
    std::uint64_t breaks = 0;
    double milliseconds = 0;
};

/** The kernels of one volume, one for each element class. */
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

    /**
     * The segments of each ray. Those of several classes are merged by merge_segments(). `wanted`: least and greatest value; only of a
     * pass that skips.
     */
    std::vector<std::vector<Segment>> lists(std::span<const SegmentRay> rays, SegmentCounts& counts,
                                            const std::array<double, 2>& wanted = {-3e38, 3e38}) const;
    /** For each ray the sum of the lengths of its segments, in its parameter; no lists are made. One class only. */
    std::vector<double> lengths(std::span<const SegmentRay> rays, SegmentCounts& counts) const;

private:
    struct ClassKernel {
        ElementLinks links;
        std::unique_ptr<ComposedKernel> kernel;
        std::uint64_t first_element = 0;
    };
    struct Rays;
    void run(const ClassKernel& of, const Rays& rays, SegmentCounts& counts) const;
    std::vector<double> ranges(const RuntimeVolume& volume, const ClassInfo& info, const SkippedField& field) const;

    const Device& m_device;
    const DeviceVolume& m_data;
    Precision m_precision;
    std::vector<ClassKernel> m_kernels;
    /** How far ends may be off. */
    double m_tolerance = 0;
    Buffer m_frame;
};

/**
 * One list from several, each in order: of parts that overlap the one entered first goes to its end, and of the others what is
 * left. Ends that agree within their errors, or are no farther apart than `least_gap`, become one, and so do parts of one element that
 * follow each other. Adds to the number of overlaps.
 */
std::vector<Segment> merge_segments(std::span<const std::vector<Segment>> lists, double least_gap, std::uint64_t& n_overlaps);

} // namespace elvis
