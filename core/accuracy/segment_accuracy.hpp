/**
 * @file segment_accuracy.hpp
 * Segments of random rays against the elements as the isoparametric shapes that they are.
 */
#pragma once

#include <core/oracle/element/volume.hpp>

#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/segments/segment_pass.hpp>
#include <core/volume/device_volume.hpp>
#include <core/vulkan/device.hpp>

#include <memory>
#include <span>

namespace elvis::oracle {

struct SegmentAccuracy {
    std::size_t n_rays = 0, n_segments = 0, n_joints = 0;
    /** Largest distance of an end from the element's boundary, and largest error of an end's parameter times max(|n.d|, 1e-3).
     */
    double end_error = 0, chord_error = 0;
    /** Ends beyond the promise: 1e-6 of the box in single, 1e-13 in double precision; not counting those of estimated segments.
     */
    std::size_t n_beyond = 0;
    /** Consecutive segments that almost share a parameter, but not exactly. */
    std::size_t n_almost_joined = 0;
    /**
     * Points by chance that lie in an element but in no segment, though the ray is not said to be undecided, and points that
     * lie in a segment but in no element; not nearer to an end than the promise.
     */
    std::size_t n_points = 0, n_missed = 0, n_invented = 0;
    /** Segments whose ends could not be computed. */
    std::size_t n_unsolved = 0;
    SegmentCounts counts;

    /** Of other rays of the same pass; leaves the pass's counts alone. */
    SegmentAccuracy& operator+=(const SegmentAccuracy& other);
};

/** Rays of one volume, judged by as many threads as the machine has cores. */
class SegmentMeasure {
public:
    /** All must outlive it. */
    SegmentMeasure(const Device& device, const RuntimeVolume& volume, const Volume& model, Precision precision);
    ~SegmentMeasure();

    /** `points_a_ray`, and `seed` of where they are: for n_missed and n_invented. */
    void add(std::span<const SegmentRay> rays, std::size_t points_a_ray, unsigned seed);
    /** Of all that were added. */
    SegmentAccuracy result() const;
    const DeviceVolume& data() const;

private:
    struct State;
    std::unique_ptr<State> m_state;
};

/** Rays through points of the volume's box in directions by chance. */
SegmentAccuracy measure_segments(const Device& device, const RuntimeVolume& volume, const Volume& model, Precision precision,
                                 std::size_t n_rays, std::size_t points_a_ray, unsigned seed);

/** Rays along outer faces: tangents of points by chance, moved in by 1e-5 to 1e-2 of the volume's diagonal. */
SegmentAccuracy measure_grazing_segments(const Device& device, const RuntimeVolume& volume, const Volume& model,
                                         Precision precision, std::size_t n_rays, std::size_t points_a_ray, unsigned seed);

} // namespace elvis::oracle
