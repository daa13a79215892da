/**
 * @file geometry_checks.cpp
 * Checks that bounds and ranges hold what the plugin evaluates: by its functions for the CPU and, where it has none, on the
 * device.
 */
#include <core/base/error.hpp>
#include <core/conformance/check.hpp>
#include <core/conformance/differences.hpp>
#include <core/conformance/evaluator.hpp>
#include <core/conformance/reference_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::conformance {

namespace {

constexpr std::size_t n_elements_checked = 24;
constexpr std::size_t n_points = 80;

std::string at_text(std::uint64_t element, const Point& xi) {
    return "element " + std::to_string(element) + " at xi " + text_of(xi);
}

void check_bounds(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    const Evaluator evaluator(context, volume);
    double tightest = 0;
    int n_complaints = 0;
    for (const std::uint64_t element : some_elements(volume, n_elements_checked, context.subject().seed)) {
        const elvis_shape shape = volume.classes()[class_of(volume, element)].shape;
        std::array<double, 6> box{};
        context.progress("element " + std::to_string(element));
        volume.bounds(element, 1, box);
        const std::vector<Point> xi = points_in(shape, n_points, context.subject().seed + element);
        const std::vector<Point> positions = evaluator.positions(element, xi);
        Point low;
        Point high;
        low.fill(std::numeric_limits<double>::infinity());
        high.fill(-std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < xi.size(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double x = positions[i][axis];
                low[axis] = std::min(low[axis], x);
                high[axis] = std::max(high[axis], x);
                if (!(x >= box[axis] && x <= box[3 + axis]) && n_complaints < 5) {
                    ++n_complaints;
                    context.fail("get_bounds: " + at_text(element, xi[i]) + ": coordinate " + std::to_string(axis) + " is " +
                                 text_of(x) + " by " + evaluator.name() + ", the bounds are [" + text_of(box[axis]) + ", " +
                                 text_of(box[3 + axis]) + "]; elements vanish from pictures where bounds are too small");
                }
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (high[axis] > low[axis]) {
                tightest = std::max(tightest, (box[3 + axis] - box[axis]) / (high[axis] - low[axis]));
            }
        }
    }
    context.note("bounds are up to " + short_text(tightest) + " times as wide as what was seen");
}

void check_ranges(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if (!volume.has_field_ranges()) {
        throw Skipped("the plugin does not give get_field_ranges");
    }
    Evaluator evaluator(context, volume);
    int n_complaints = 0;
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        evaluator.select(field);
        const std::uint32_t n_components = volume.fields()[field].n_components;
        for (const std::uint64_t element : some_elements(volume, n_elements_checked, context.subject().seed)) {
            std::vector<FieldRange> ranges(n_components);
            context.progress("element " + std::to_string(element));
            volume.field_ranges(field, 0, element, 1, ranges);
            const elvis_shape shape = volume.classes()[class_of(volume, element)].shape;
            const std::vector<Point> xi = points_in(shape, n_points, context.subject().seed + element);
            for (std::uint32_t component = 0; component < n_components; ++component) {
                const auto values = evaluator.values(element, xi, component);
                for (std::size_t i = 0; i < xi.size(); ++i) {
                    const double value = values[i].first;
                    if ((value < ranges[component].lower || value > ranges[component].upper) && n_complaints < 5) {
                        ++n_complaints;
                        context.fail("get_field_ranges: field " + volume.fields()[field].name + ", " + at_text(element, xi[i]) +
                                     ": " + text_of(value) + " by " + evaluator.name() + ", the range is [" +
                                     text_of(ranges[component].lower) + ", " + text_of(ranges[component].upper) + "]");
                    }
                }
            }
        }
    }
}

/** Sums of first and second derivatives of a component at points. */
std::vector<DerivativeBounds> sums_of_derivatives(const Evaluator& evaluator, std::size_t dimension, std::uint64_t element,
                                                  const std::vector<Point>& xi, std::uint32_t component) {
    std::vector<DerivativeBounds> sums(xi.size());
    const auto centre = evaluator.values(element, xi, component);
    for (std::size_t j = 0; j < dimension; ++j) {
        const auto derivative = differences(xi, j, [&](const std::vector<Point>& points) {
            std::vector<std::vector<double>> gradients;
            for (const auto& [value, gradient] : evaluator.values(element, points, component)) {
                gradients.push_back({gradient[0], gradient[1], gradient[2]});
            }
            return gradients;
        });
        for (std::size_t i = 0; i < xi.size(); ++i) {
            sums[i].first += std::abs(centre[i].second[j]);
            for (std::size_t l = 0; l < dimension; ++l) {
                sums[i].second += std::abs(derivative[i][l]);
            }
        }
    }
    return sums;
}

/** A function that bounds derivatives, and what it says of one element. */
struct ClaimedBounds {
    std::string function;
    const char* name_of_second;
    bool is_apex_weighted;
    std::vector<DerivativeBounds> of_components;
};

std::vector<ClaimedBounds> claimed_bounds(const RuntimeVolume& volume, std::uint32_t field, std::uint64_t element) {
    std::vector<ClaimedBounds> claims;
    const std::vector<DerivativeBounds> none(volume.fields()[field].n_components);
    if (volume.has_derivative_bounds()) {
        claims.push_back({"get_field_derivative_bounds", "H", false, none});
        volume.derivative_bounds(field, 0, element, 1, claims.back().of_components);
    }
    if (volume.has_apex_bounds() && volume.classes()[class_of(volume, element)].shape == ELVIS_SHAPE_PYRAMID) {
        claims.push_back({"get_field_apex_bounds", "B", true, none});
        volume.apex_bounds(field, 0, element, 1, claims.back().of_components);
    }
    return claims;
}

/** What is wrong with a claim at a point; nothing if it holds. */
std::string broken_claim(const ClaimedBounds& claim, std::uint32_t component, const Point& xi, const DerivativeBounds& sums) {
    const DerivativeBounds& bounds = claim.of_components[component];
    if (sums.first > bounds.first * (1 + 1e-12)) {
        return "first derivatives sum to " + text_of(sums.first) + ", L is " + text_of(bounds.first);
    }
    const double second = (claim.is_apex_weighted ? 0.5 * (1 - xi[2]) : 1) * sums.second;
    // Differences of gradients are good to about 1e-8 of the gradients.
    if (second > bounds.second + 1e-7 * (sums.first + bounds.second)) {
        return "second derivatives sum to " + text_of(sums.second) + ", " + claim.name_of_second + " is " +
               text_of(bounds.second);
    }
    return {};
}

void check_derivative_bounds(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if (!volume.has_derivative_bounds() && !volume.has_apex_bounds()) {
        throw Skipped("the plugin does not give get_field_derivative_bounds");
    }
    Evaluator evaluator(context, volume);
    int n_complaints = 0;
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        evaluator.select(field);
        for (const std::uint64_t element : some_elements(volume, n_elements_checked / 2, context.subject().seed)) {
            context.progress("element " + std::to_string(element));
            const std::vector<ClaimedBounds> claims = claimed_bounds(volume, field, element);
            const elvis_shape shape = volume.classes()[class_of(volume, element)].shape;
            const std::vector<Point> xi = interior_points(shape, n_points / 4, context.subject().seed + element);
            for (std::uint32_t component = 0; component < volume.fields()[field].n_components; ++component) {
                const auto sums = sums_of_derivatives(evaluator, volume.dimension(), element, xi, component);
                for (std::size_t i = 0; i < xi.size(); ++i) {
                    for (const ClaimedBounds& claim : claims) {
                        const std::string broken = broken_claim(claim, component, xi[i], sums[i]);
                        if (!broken.empty() && n_complaints++ < 5) {
                            context.fail(claim.function + ": field " + volume.fields()[field].name + ", " +
                                         at_text(element, xi[i]) + ": " + broken);
                        }
                    }
                }
            }
        }
    }
}

double determinant(const double* j) {
    return j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) + j[2] * (j[3] * j[7] - j[4] * j[6]);
}

void check_jacobian_signs(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if (!volume.has_jacobian_checks() || volume.dimension() != 3) {
        throw Skipped("the plugin does not give check_jacobians");
    }
    if (!volume.has_evaluation()) {
        throw Skipped("needs evaluate_mapping");
    }
    int n_complaints = 0;
    for (const std::uint64_t element : some_elements(volume, n_elements_checked, context.subject().seed)) {
        std::array<JacobianCheck, 1> answer{};
        context.progress("element " + std::to_string(element));
        volume.check_jacobians(element, 1e-6, answer);
        const JacobianCheck& check = answer[0];
        const elvis_shape shape = volume.classes()[class_of(volume, element)].shape;
        std::vector<Point> xi = interior_points(shape, n_points, context.subject().seed + element);
        xi.push_back(check.xi);
        std::vector<double> jacobians(9 * xi.size());
        volume.evaluate_mapping(element, flat(xi), {}, jacobians);
        double largest = 0;
        for (std::size_t i = 0; i + 1 < xi.size(); ++i) {
            largest = std::max(largest, std::abs(determinant(&jacobians[9 * i])));
        }
        const double rounding = 1e-12 * largest;
        for (std::size_t i = 0; i + 1 < xi.size() && n_complaints < 5; ++i) {
            const double found = determinant(&jacobians[9 * i]);
            if (check.sign == ELVIS_JACOBIAN_POSITIVE && !(found > 0 && found >= check.lower - rounding)) {
                ++n_complaints;
                context.fail("check_jacobians: " + at_text(element, xi[i]) + ": the determinant is " + text_of(found) +
                             ", said to be positive and not below " + text_of(check.lower));
                break;
            }
        }
        if (check.sign == ELVIS_JACOBIAN_NEGATIVE && n_complaints < 5) {
            const double found = determinant(&jacobians[9 * (xi.size() - 1)]);
            if (!(found < 0) || std::abs(found - check.determinant) > 1e-9 * largest) {
                ++n_complaints;
                context.fail("check_jacobians: " + at_text(element, check.xi) + ": the determinant is " + text_of(found) +
                             ", said to be " + text_of(check.determinant));
            }
        }
    }
}

/** Given derivatives beside differences of what they are derivatives of. */
struct DerivativeComparison {
    Context& context;
    int n_complaints = 0;
    double worst = 0;

    void operator()(const std::string& what, const Point& xi, double given, double expected, double scale) {
        const double error = std::abs(given - expected);
        worst = std::max(worst, scale > 0 ? error / scale : 0.0);
        if (!(error <= 1e-7 * scale) && n_complaints < 5) {
            ++n_complaints;
            context.fail(what + " at xi " + text_of(xi) + ": " + text_of(given) + " is given, differences say " +
                         text_of(expected));
        }
    }
};

void compare_jacobians(DerivativeComparison& compare, const RuntimeVolume& volume, std::uint64_t element,
                       const std::vector<Point>& xi, const std::string& which) {
    std::vector<double> jacobians(9 * xi.size());
    volume.evaluate_mapping(element, flat(xi), {}, jacobians);
    double scale = 0;
    for (const double entry : jacobians) {
        scale = std::max(scale, std::abs(entry));
    }
    for (std::size_t j = 0; j < volume.dimension(); ++j) {
        const auto expected = differences(xi, j, [&](const std::vector<Point>& at) {
            std::vector<double> positions(3 * at.size());
            volume.evaluate_mapping(element, flat(at), positions, {});
            return rows(positions, 3);
        });
        for (std::size_t i = 0; i < xi.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                compare("evaluate_mapping: dx_" + std::to_string(k) + "/dxi_" + std::to_string(j) + " " + which, xi[i],
                        jacobians[9 * i + 3 * k + j], expected[i][k], scale);
            }
        }
    }
}

void compare_gradients(DerivativeComparison& compare, const RuntimeVolume& volume, std::uint64_t element, std::uint32_t field,
                       const std::vector<Point>& xi, const std::string& which) {
    const std::uint32_t n = volume.fields()[field].n_components;
    std::vector<double> values(n * xi.size());
    std::vector<double> gradients(3 * n * xi.size());
    volume.evaluate_field(field, 0, element, flat(xi), values, gradients);
    double size = 0;
    for (std::size_t i = 0; i < gradients.size(); ++i) {
        size = std::max({size, std::abs(gradients[i]), 1e-3 * std::abs(values[i / 3])});
    }
    for (std::size_t j = 0; j < volume.dimension(); ++j) {
        const auto expected = differences(xi, j, [&](const std::vector<Point>& at) {
            std::vector<double> there(n * at.size());
            volume.evaluate_field(field, 0, element, flat(at), there, {});
            return rows(there, n);
        });
        for (std::size_t i = 0; i < xi.size(); ++i) {
            for (std::uint32_t component = 0; component < n; ++component) {
                compare("evaluate_field: derivative by xi_" + std::to_string(j) + " of " + volume.fields()[field].name + " " +
                            which,
                        xi[i], gradients[3 * (n * i + component) + j], expected[i][component], size);
            }
        }
    }
}

void check_cpu_derivatives(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if (!volume.has_evaluation()) {
        throw Skipped("the plugin does not evaluate on the CPU");
    }
    DerivativeComparison compare{context};
    for (const std::uint64_t element : some_elements(volume, n_elements_checked / 2, context.subject().seed)) {
        const elvis_shape shape = volume.classes()[class_of(volume, element)].shape;
        const std::vector<Point> xi = interior_points(shape, n_points / 4, context.subject().seed + element);
        const std::string which = "of element " + std::to_string(element);
        context.progress("derivatives " + which);
        compare_jacobians(compare, volume, element, xi, which);
        for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
            compare_gradients(compare, volume, element, field, xi, which);
        }
    }
    context.note("largest difference " + short_text(compare.worst) + " of the largest derivative");
}

} // namespace

std::vector<Check> geometry_checks() {
    return {
        {"bounds", "every element lies inside its bounds", check_bounds},
        {"field-ranges", "the field in every element lies within its range", check_ranges},
        {"derivative-bounds", "first and second derivatives of the field are no larger than their bounds",
         check_derivative_bounds},
        {"jacobian-signs", "signs and lower bounds of Jacobian determinants hold, and witnesses are negative",
         check_jacobian_signs},
        {"cpu-derivatives",
         "Jacobians and gradients of the evaluation on the CPU are the derivatives of its positions and values",
         check_cpu_derivatives},
    };
}

} // namespace elvis::conformance
