/**
 * @file knots.hpp
 * Knot vectors and their B-splines.
 */
#pragma once

#include <array>
#include <vector>

namespace elvis_mfem {

class Text;

inline constexpr int max_spline_order = 10;

struct KnotVector {
    int order = 1;
    /** Ascending; as many as control points, and order + 1. */
    std::vector<double> knots;

    int n_control_points() const { return static_cast<int>(knots.size()) - order - 1; }
    /** Indices of the knots at which spans of positive length begin. */
    std::vector<int> spans() const;
    /** The same in the other direction. */
    KnotVector reversed() const;
    /** The order + 1 B-splines that do not vanish in a span, at t in [0, 1] of it; they belong to control points span - order
     * .. span. */
    std::array<double, max_spline_order + 1> evaluate(int span, double t) const;
};

KnotVector read_knot_vector(Text& text);

} // namespace elvis_mfem
