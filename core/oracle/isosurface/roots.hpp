/**
 * @file roots.hpp
 * Roots of a function of one variable by samples, brackets, and a closer look near extremes, where two roots may hide.
 */
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace elvis::oracle {

using RealFunction = std::function<double(double)>;

struct Roots {
    /** Ascending. */
    std::vector<double> at;
    /** Local minima of |function| that are none: where, and the function's value there. */
    struct NearMiss {
        double at = 0, value = 0;
    };
    std::vector<NearMiss> near_misses;
};

/**
 * `values` are those of the function less `level` at ascending `points`. A closer look is taken at extremes that a parabola
 * through samples lets come near zero.
 */
Roots find_roots(const RealFunction& function, double level, std::span<const double> points, std::span<const double> values);

/** The same, with a closer look beside every change of sign, too: between its samples and the next, two more roots may hide. */
Roots find_close_roots(const RealFunction& function, double level, std::span<const double> points,
                       std::span<const double> values);

} // namespace elvis::oracle
