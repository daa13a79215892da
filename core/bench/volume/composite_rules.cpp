#include <core/bench/volume/composite_rules.hpp>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis {

namespace {

/** On [0, 1]; weights add up to 1. */
struct Rule {
    std::vector<double> points, weights;
    /** The last point is the next interval's first. */
    bool shares_ends = false;
};

/** From the nodes of [-1, 1] that are not negative. */
template <class Points, class Weights> Rule rule_from(const Points& points, const Weights& weights) {
    Rule rule;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (const double sign : {-1.0, 1.0}) {
            if (points[i] != 0 || sign > 0) {
                rule.points.push_back(0.5 + 0.5 * sign * points[i]);
                rule.weights.push_back(0.5 * weights[i]);
            }
        }
    }
    return rule;
}

Rule rule_of(CompositeRule rule) {
    namespace quadrature = boost::math::quadrature;
    switch (rule) {
    case CompositeRule::riemann:
        return {{0}, {1}};
    case CompositeRule::midpoint:
        return {{0.5}, {1}};
    case CompositeRule::trapezoid:
        return {{0, 1}, {0.5, 0.5}, true};
    case CompositeRule::simpson:
        return {{0, 0.5, 1}, {1.0 / 6, 4.0 / 6, 1.0 / 6}, true};
    case CompositeRule::gauss_legendre: {
        const double outer = std::sqrt(0.6);
        return rule_from(std::array{0.0, outer}, std::array{8.0 / 9, 5.0 / 9});
    }
    case CompositeRule::gauss_kronrod:
        break;
    }
    return rule_from(quadrature::gauss_kronrod<double, 15>::abscissa(), quadrature::gauss_kronrod<double, 15>::weights());
}

} // namespace

const char* name_of(CompositeRule rule) {
    constexpr std::array<const char*, 6> names{"Riemann", "midpoint",       "trapezoid",
                                               "Simpson", "Gauss-Legendre", "Gauss-Kronrod"};
    return names[static_cast<std::size_t>(rule)];
}

int order_of(CompositeRule rule) {
    // Kronrod's 15 points are exact to degree 3 * 7 + 2, for 7 is odd.
    constexpr std::array<int, 6> orders{1, 2, 2, 4, 6, 24};
    return orders[static_cast<std::size_t>(rule)];
}

std::size_t samples_of(CompositeRule rule, std::size_t n_intervals) {
    const Rule of_one = rule_of(rule);
    const std::size_t n_own = of_one.points.size() - (of_one.shares_ends ? 1 : 0);
    return n_intervals * n_own + (of_one.shares_ends ? 1 : 0);
}

double integrate(CompositeRule rule, const RealFunction& function, double from, double to, std::size_t n_intervals) {
    const Rule of_one = rule_of(rule);
    const double h = (to - from) / static_cast<double>(n_intervals);
    double sum = 0;
    for (std::size_t interval = 0; interval < n_intervals; ++interval) {
        for (std::size_t i = 0; i < of_one.points.size(); ++i) {
            const double share = (static_cast<double>(interval) + of_one.points[i]) / static_cast<double>(n_intervals);
            sum += of_one.weights[i] * function((1 - share) * from + share * to);
        }
    }
    return h * sum;
}

std::vector<RuleError> rule_errors(CompositeRule rule, const RealFunction& function, double from, double to, double integral,
                                   std::span<const std::size_t> n_intervals) {
    std::vector<RuleError> errors;
    for (const std::size_t n : n_intervals) {
        errors.push_back({n, samples_of(rule, n), std::abs(integrate(rule, function, from, to, n) - integral)});
    }
    return errors;
}

double measured_order(std::span<const RuleError> errors, double least, std::size_t window) {
    std::vector<std::array<double, 2>> points;
    for (std::size_t first = 0; first + window <= errors.size(); first += window) {
        const auto of_window = errors.subspan(first, window);
        const RuleError& largest = *std::max_element(of_window.begin(), of_window.end(),
                                                     [](const RuleError& a, const RuleError& b) { return a.error < b.error; });
        if (largest.error >= least) {
            points.push_back({std::log(static_cast<double>(largest.n_intervals)), std::log(largest.error)});
        }
    }
    if (points.size() < 2) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    std::array<double, 2> mean{};
    for (const auto& point : points) {
        mean[0] += point[0] / static_cast<double>(points.size());
        mean[1] += point[1] / static_cast<double>(points.size());
    }
    double along = 0, across = 0;
    for (const auto& point : points) {
        along += (point[0] - mean[0]) * (point[0] - mean[0]);
        across += (point[0] - mean[0]) * (point[1] - mean[1]);
    }
    return -across / along;
}

double BrokenCubic::value(double t) {
    return t <= breakpoint ? ((-2 * t + 4) * t - 1) * t + 0.688528 : ((2 * t - 4) * t + 1) * t + 1.311472;
}

double BrokenCubic::integral(double t) {
    const auto before = [](double s) { return (((-0.5 * s + 4.0 / 3) * s - 0.5) * s + 0.688528) * s; };
    const auto after = [](double s) { return (((0.5 * s - 4.0 / 3) * s + 0.5) * s + 1.311472) * s; };
    return t <= breakpoint ? before(t) : before(breakpoint) + after(t) - after(breakpoint);
}

} // namespace elvis
