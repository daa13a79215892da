/**
 * @file segments.hpp
 * The segments of a straight ray in curved elements: where it crosses the element's faces, found by subdivision of their
 * Bernstein forms, which cannot miss a crossing.
 */
#pragma once

#include <core/oracle/element/inversion.hpp>
#include <core/oracle/picture/picture.hpp>

#include <array>
#include <limits>
#include <vector>

namespace elvis::oracle {

/** origin + t direction, of unit length, for t >= 0. */
struct Line {
    Vector origin, direction;

    Vector at(double t) const { return origin + t * direction; }
};

struct RaySegment {
    double from = 0, to = 0;
    /** Reference coordinates at (from + to) / 2. */
    Vector middle;
};

/** Of a volume none of whose elements is folded. The model must outlive it. */
class SegmentFinder {
public:
    explicit SegmentFinder(const Model& model);

    struct Entry {
        std::size_t element = 0;
        double from = 0;
    };
    /** Elements whose box the line meets, ascending by where it does. */
    std::vector<Entry> boxes(const Line& line) const;

    /** Segments in one element, ascending. The inverter is the caller's thread's. */
    std::vector<RaySegment> find(std::size_t element, const Line& line, Inverter& inverter) const;

    /** Where the line meets one face, the one of face_constraints(shape)[constraint]; t may be negative. */
    std::vector<double> crossings(std::size_t element, std::size_t constraint, const Line& line) const;

private:
    /** A face as a Bernstein patch. */
    struct Face {
        /** Index of its constraint. */
        std::size_t constraint = 0;
        std::array<std::size_t, 2> order{};
        std::vector<Vector> points;
    };
    static void cross(const Face& face, const Line& line, double scale, std::vector<double>& crossings);

    const Model& m_model;
    std::vector<std::vector<Face>> m_faces;
};

} // namespace elvis::oracle
