/**
 * @file lines.hpp
 * Which contours and borders of elements a square of the picture meets, in double precision: samples of what is seen, and
 * bisection between those that differ.
 */
#pragma once

#include <core/oracle/scene/scene_oracle.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace elvis::hunt {

/** Of the picture, in pixels. */
struct PictureSquare {
    double column = 0, row = 0, half = 0.5;
};

enum class LineKind { contour, mesh_line };

struct LineSearch {
    LineKind kind = LineKind::contour;
    /** By how much values on both sides must be off an isovalue; below zero, a value this near to one counts as one. */
    double beyond = 0;
    /** Samples in each direction. */
    int n = 9;
};

/** For one thread, and a request of one surface. */
class LineOracle {
public:
    LineOracle(oracle::SceneOracle& oracle, const FrameRequest& request);

    /**
     * A line is certainly there: between two samples whose values, or elements, differ, and which bisection brings together at
     * one place of the surface. A jump between elements is no contour.
     */
    bool is_proven(const PictureSquare& square, const LineSearch& search);
    /** The same, and looks closer where samples come near to a line: what this does not find is there in rare cases only. */
    bool is_found(const PictureSquare& square, const LineSearch& search);

    /** World length of a pixel at this distance from the ray's origin. */
    double pixel_length(double depth) const;

private:
    /** What is seen at a place of the picture. */
    struct Sight {
        double column = 0, row = 0;
        bool is_hit = false;
        std::size_t element = 0;
        /** Of faces of elements: which one. */
        std::size_t face = 0;
        double value = 0, depth = 0;
        oracle::Vector position = oracle::Vector::Zero();
        /** Largest constraint of a face in which the surface does not lie: 0 on the border of the element, negative inside. */
        double border = -1;
    };
    Sight see(double column, double row);
    void set_border(const oracle::SurfacePoint& point, Sight& sight) const;
    std::vector<Sight> sights(const PictureSquare& square, int n);
    bool is_between(const std::vector<Sight>& sights, const LineSearch& search, int n);
    bool meets_contour(const Sight& a, const Sight& b, double beyond, int depth);
    bool meets_border(const Sight& a, const Sight& b, int depth);
    bool straddles(const Sight& a, const Sight& b, double beyond) const;
    bool is_one_place(const Sight& a, const Sight& b) const;
    /** How far the sample is from a line, in whatever is zero there. */
    double distance(const Sight& sight, LineKind kind) const;
    bool is_closer(const PictureSquare& square, Sight start, double half, const LineSearch& search);
    bool is_between(const Sight& a, const Sight& b, const LineSearch& search);
    /** Whether a line comes in at an edge of the square, however little of it: a sliver lies between samples. */
    bool enters_at_edge(const PictureSquare& square, const LineSearch& search);
    bool comes_near(Sight from, Sight to, const LineSearch& search);

    oracle::SceneOracle& m_oracle;
    const FrameRequest& m_request;
    const Surface& m_surface;
    bool m_is_on_faces;
};

} // namespace elvis::hunt
