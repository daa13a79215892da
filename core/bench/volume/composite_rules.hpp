/**
 * @file composite_rules.hpp
 * Quadrature of a function of one variable by the same rule in many intervals, and how fast its error falls: what B. Nelson
 * (2012), section 6.3, says of functions with a breakpoint.
 */
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace elvis {

enum class CompositeRule {
    riemann, ///< the value at the start of each interval
    midpoint,
    trapezoid,
    simpson,
    gauss_legendre, ///< 3 points
    gauss_kronrod   ///< 15 points
};

inline constexpr std::array<CompositeRule, 6> composite_rules{CompositeRule::riemann,        CompositeRule::midpoint,
                                                              CompositeRule::trapezoid,      CompositeRule::simpson,
                                                              CompositeRule::gauss_legendre, CompositeRule::gauss_kronrod};

const char* name_of(CompositeRule rule);

/** The power of the interval's length by which the error falls for smooth functions. */
int order_of(CompositeRule rule);

/** Evaluations in n intervals; neighbours share those at their ends. */
std::size_t samples_of(CompositeRule rule, std::size_t n_intervals);

using RealFunction = std::function<double(double)>;

double integrate(CompositeRule rule, const RealFunction& function, double from, double to, std::size_t n_intervals);

struct RuleError {
    std::size_t n_intervals = 0, n_samples = 0;
    /** Size of the difference from the integral. */
    double error = 0;
};

std::vector<RuleError> rule_errors(CompositeRule rule, const RealFunction& function, double from, double to, double integral,
                                   std::span<const std::size_t> n_intervals);

/**
 * The power by which errors fall with the number of intervals: the slope of a line through their logarithms by least squares.
 * Where a breakpoint lies in its interval changes with their number and moves the error by a factor between 0 and 1: the line
 * is drawn through the largest error of every `window` neighbours. Errors below `least` are rounding, and left out; NaN if
 * fewer than two are left.
 */
double measured_order(std::span<const RuleError> errors, double least = 1e-13, std::size_t window = 1);

/** Equation 6.29: two cubic polynomials on [0, 1], that meet at a breakpoint with slopes 1.57 and -1.57. */
struct BrokenCubic {
    static constexpr double breakpoint = 0.54;

    static double value(double t);
    /** Over [0, t]. */
    static double integral(double t);
};

} // namespace elvis
