/**
 * @file cube_maximum.hpp
 * The largest value that a polynomial, or the magnitude of several, takes over the collapsed cube, by branch and bound:
 * Bernstein forms bound it, their corners are values, and the part with the largest bound is halved until both agree. Both
 * converge quadratically with the size of the part.
 */
#pragma once

#include "halving.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace elvis::native {

/** What is made large. Smallest values are largest ones with the sign changed. */
enum class Objective {
    value,             ///< one form
    negative,          ///< its negative
    magnitude,         ///< the Euclidean length of all forms together
    negative_magnitude ///< its negative
};

/** A value of the objective, and where it is taken. */
struct Peak {
    double value = 0;
    Point xi{};
};

class CubeMaximum {
public:
    CubeMaximum(Shape shape, const Sizes& sizes, std::size_t n_forms, Objective objective);

    /**
     * No value over the whole cube is larger. forms[form * size + k]; `error` bounds what is wrong with any coefficient.
     *
     * For the magnitude: u is a mean of the control vectors b_k with weights that are positive and sum to 1, so |u| <= max
     * |b_k|, and |u| >= d.u >= min d.b_k for each unit vector d.
     */
    double bound(std::span<const double> forms, double error) const;

    /** The largest value at the corners of the cube. */
    Peak largest_corner(std::span<const double> forms) const;

    /**
     * Raises `best` to a value that no value of the objective exceeds by more than `tolerance`, if there is such a one above
     * it, and returns a bound of all values: at most best + tolerance, unless rounding or the number of parts set an end
     * before.
     */
    double search(std::span<const double> forms, double error, double tolerance, Peak& best);

private:
    struct Part {
        CubePart region;
        double bound = 0, error = 0;
        std::size_t place = 0; // of its forms in m_numbers, in units of all forms' size
    };

    double at(std::span<const double> forms, std::size_t k) const;
    void raise(std::span<const double> forms, const CubePart& region, Peak& best) const;
    std::span<double> numbers(std::size_t place);
    std::size_t direction_to_halve(const Part& part);
    std::size_t new_place();
    void halve(const Part& part, std::size_t direction, double scale, Part& lower, Part& upper);

    Shape m_shape;
    FormLayout m_layout;
    std::size_t m_n_forms;
    Objective m_objective;
    std::vector<double> m_numbers;
    std::vector<std::size_t> m_free;
    std::vector<Part> m_queue; // heap, the largest bound first
};

} // namespace elvis::native
