/**
 * @file isosurface_compare.hpp
 * A frame of the renderer against the oracle's isosurfaces, pixel by pixel.
 */
#pragma once

#include "isosurface.hpp"

#include <string>

namespace elvis::oracle {

/** What rounding may do. */
struct IsosurfaceTolerance {
    /** Of depth, over the volume's diagonal plus the depth. */
    double depth = 0;
    /** Of the field, over its range: a ray that comes this near to an isovalue may cross it or not. */
    double field = 0;
};
inline constexpr IsosurfaceTolerance float32_tolerance{1e-5, 2e-5}, float64_tolerance{1e-12, 1e-12};

/** Surfaces that rays meet at less than this |normal . direction| are judged by the distance from the surface. */
inline constexpr double grazing = 0.05;

/** Decides whether a depth is that of a first crossing, if the field may be off by rounding. */
class IsosurfaceJudge {
public:
    IsosurfaceJudge(IsosurfaceTracer& tracer, const IsosurfaceTolerance& tolerance)
        : m_tracer(tracer), m_tolerance(tolerance) {}

    /**
     * NaN: no crossing. Accepted if the field is within the tolerance of an isovalue there, and in front of it never goes from
     * beyond the tolerance on one side of an isovalue to beyond it on the other, in one element or across a face where it is
     * continuous.
     */
    bool accepts(const Line& line, double depth);

private:
    double certain_crossing(const std::vector<FittedInterval>& intervals, double value) const;
    bool is_on_surface(const std::vector<FittedInterval>& intervals, double depth) const;
    double length(double depth) const { return m_tolerance.depth * (m_tracer.model().diagonal + depth); }

    IsosurfaceTracer& m_tracer;
    IsosurfaceTolerance m_tolerance;
};

struct IsosurfaceComparison {
    std::size_t n_pixels = 0, n_hits = 0;
    /** The same crossing within the tolerance of the depth, or none. */
    std::size_t n_agree = 0;
    /** Another answer that the judge accepts. */
    std::size_t n_rounding = 0;
    /** Another answer that the judge does not accept: in pixels that say so, in others that graze a surface, and in the rest.
     */
    std::size_t n_wrong_flagged = 0, n_wrong_grazing = 0, n_wrong = 0;
    /** Pixels that say that they are undecided, and those of them that agree. */
    std::size_t n_flagged = 0, n_needless_flags = 0;
    /** Pixels whose isosurface bit is not what the other buffers say. */
    std::size_t n_wrong_masks = 0;
    /** Pixels that agree but name another element, well inside of the right one. */
    std::size_t n_other_element = 0;
    /** Where |normal . direction| is not grazing: of depth over diagonal plus depth, and |difference| of the unit normals. */
    double depth_error = 0, normal_error = 0;
    /** Elsewhere: distance from the surface, to first order, over the depth. */
    double grazing_distance = 0;
    /** |field - isovalue| over the range where the frame has its hits, to first order. */
    double residual = 0;
    /** A wrong pixel, or the one of the largest error of depth. */
    std::size_t worst_pixel = 0;

    IsosurfaceComparison& operator+=(const IsosurfaceComparison& other);
};

/** The tracer is that of the picture's isosurface, and the camera its. */
IsosurfaceComparison compare(IsosurfaceTracer& tracer, const IsosurfacePicture& exact, const Camera& camera, const Frame& frame,
                             const IsosurfaceTolerance& tolerance);

/** For people: a line for each thing counted. */
std::string to_text(const IsosurfaceComparison& comparison);

} // namespace elvis::oracle
