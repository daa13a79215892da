/**
 * @file isosurface.hpp
 * Where rays first cross the isosurfaces of a field, in double precision. The field along the segment of a ray in an element
 * becomes a Chebyshev series, taken as often as it needs; roots are found in it, or by two slower methods that check each
 * other.
 */
#pragma once

#include "chebyshev.hpp"
#include "roots.hpp"
#include "scalar.hpp"
#include "segments.hpp"
#include <core/oracle/picture/ray.hpp>

#include <array>
#include <optional>
#include <vector>

namespace elvis::oracle {

struct Isosurface {
    Scalar scalar;
    /** Ascending. */
    std::vector<double> values;
    /** As Surface::clip. */
    std::vector<std::array<double, 4>> clip{};
};

struct Crossing {
    double t = 0;
    std::size_t element = 0;
    Vector xi, position;
    /** Index of the isovalue. */
    std::size_t value = 0;
    /** Of unit length, towards the viewer. */
    Vector normal;
    /** |normal . direction| */
    double facing = 0;
    /** |gradient| in world coordinates. */
    double slope = 0;
};

enum class RootFinder {
    series,   ///< samples of the series, brackets, extremes
    samples,  ///< the same with many samples of the true field in place of the series
    companion ///< eigenvalues of the series' companion matrix
};

struct RayAnswer {
    std::optional<Crossing> crossing;
    /**
     * The least |field - isovalue| over the field's range where the ray comes nearest to an isovalue without taking it: in all
     * of its segments, or, where there is a crossing, at extremes in front of it. Infinity if there is no such place.
     */
    double margin = std::numeric_limits<double>::infinity();
};

/** The field along an interval of a ray in one element. */
struct FittedInterval {
    std::size_t element = 0;
    double from = 0, to = 0;
    ChebyshevSeries field;
    /** Reference coordinates at lobatto_points(xi.size() - 1). */
    std::vector<Vector> xi;

    double t_of(double s) const { return 0.5 * ((1 - s) * from + (1 + s) * to); }
};

/** For one thread. The model must outlive it. */
class IsosurfaceTracer {
public:
    IsosurfaceTracer(const Model& model, const Isosurface& isosurface);

    /**
     * The first crossing with t > 0, each element by itself; of elements that share it the one with the lowest number. A value
     * that is taken at the very end of a segment counts.
     */
    RayAnswer first(const Line& line, RootFinder finder = RootFinder::series);

    /**
     * All crossings with t > 0, ascending, as if the field were lower by `shift`. Crossings of different elements that touch
     * are one.
     */
    std::vector<Crossing> all(const Line& line, double shift = 0);

    /** All intervals up to a distance, element by element in the order in which their boxes are met. */
    std::vector<FittedInterval> intervals(const Line& line, double until = std::numeric_limits<double>::infinity());

    /** The field's smallest and largest value among samples of all elements. */
    double low() const { return m_low; }
    double high() const { return m_high; }
    double range() const { return m_high - m_low; }

    const Isosurface& isosurface() const { return m_isosurface; }
    const Model& model() const { return m_model; }

    /** Times that Newton's method and the search that cannot miss both failed to follow a ray; the answer may be wrong. */
    std::uint64_t n_failures() const { return m_failures; }

    /** Value and gradient in world coordinates at a point of an element. */
    double value(std::size_t element, const Vector& xi, Vector* gradient = nullptr) const;

private:
    struct Root {
        double t = 0;
        std::size_t value = 0;
        /** Near the reference coordinates. */
        Vector xi;
    };
    struct Found {
        std::optional<Root> first;
        struct NearMiss {
            double t = 0, size = 0;
            bool is_end = false;
        };
        std::vector<NearMiss> near_misses;
    };
    std::vector<RaySegment> clipped_segments(std::size_t element, const Line& line);
    void add_intervals(std::size_t element, const Line& line, const RaySegment& segment,
                       std::vector<FittedInterval>& intervals);
    /** Reference coordinates of an interval at its lobatto_points(n), from the middle outwards, along tangents. */
    void follow_outwards(const Line& line, const RaySegment& segment, std::size_t n, FittedInterval& interval);
    Vector follow(std::size_t element, const Vector& x, const Vector& start, Matrix* jacobian = nullptr);
    void search(const FittedInterval& interval, RootFinder finder, Found& found) const;
    void search_by_samples(std::size_t element, const Line& line, const RaySegment& segment, Found& found);
    void keep(const Roots& roots, const FittedInterval& interval, std::size_t value, Found& found) const;
    Crossing polish(std::size_t element, const Line& line, const Root& root, double shift = 0);
    void add_roots(const FittedInterval& interval, double shift, std::vector<std::pair<std::size_t, Root>>& roots) const;

    const Model& m_model;
    Isosurface m_isosurface;
    SegmentFinder m_segment_finder;
    Inverter m_inverter;
    double m_low = 0, m_high = 0;
    /** What rounding leaves of the field, about. */
    double m_rounding = 0;
    std::uint64_t m_failures = 0;
};

/** Answers for all pixels of a picture, by as many threads as the machine has cores. */
struct IsosurfacePicture {
    std::vector<RayAnswer> answers;
    double range = 0;
    std::uint64_t n_failures = 0;
    double seconds = 0;
};
IsosurfacePicture draw_isosurface(const Model& model, const Isosurface& isosurface, const Camera& camera, std::uint32_t width,
                                  std::uint32_t height, RootFinder finder = RootFinder::series);

Line line_of(const Ray& ray);

} // namespace elvis::oracle
