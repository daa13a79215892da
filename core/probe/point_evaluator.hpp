/**
 * @file point_evaluator.hpp
 * Inverse mapping and fields at points of known elements, in double precision, on the CPU or on the device.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/expression/expression.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace elvis {

/** Whether an element contains a position. */
struct InversionQuery {
    std::uint64_t element = 0;
    Vector3 position{};
};

/** Of a point that was not found. */
inline constexpr Vector3 nowhere{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::quiet_NaN()};

struct Inversion {
    enum class Outcome {
        inside,  ///< in the closed element, but for rounding
        outside, ///< not in the element
        failed   ///< neither could be established
    };
    Outcome outcome = Outcome::failed;
    /** Outside where the linear model of a point of the element has it; NaN if that never settled. */
    Vector3 xi = nowhere;
};

/** A point of an element. */
struct ReferencePoint {
    std::uint64_t element = 0;
    Vector3 xi{};
};

/** Components of a field and their gradients in world coordinates (three numbers a component). */
struct FieldSample {
    std::vector<double> values;
    std::vector<double> gradients;
    /** The gradient rests on differences of values, because the plugin gives none. */
    bool gradient_is_estimated = false;
};

/** An expression and its gradient in world coordinates. */
struct ExpressionSample {
    double value = 0;
    Vector3 gradient{};
    /** Rests on differences of what the plugin gives. */
    bool value_is_estimated = false;
    bool gradient_is_estimated = false;
};

class PointEvaluator {
public:
    PointEvaluator() = default;
    virtual ~PointEvaluator() = default;
    PointEvaluator(const PointEvaluator&) = delete;
    PointEvaluator& operator=(const PointEvaluator&) = delete;

    /** Whether several threads may ask at a time. */
    virtual bool is_for_any_thread() const { return false; }

    /** One answer a query, in the same order. */
    virtual std::vector<Inversion> invert(std::span<const InversionQuery> queries) = 0;

    /** One sample a point, in the same order. Without gradients these may be missing. */
    virtual std::vector<FieldSample> evaluate(std::uint32_t field, std::uint32_t time_step,
                                              std::span<const ReferencePoint> points, bool with_gradients) = 0;

    /** Likewise. The expression is over the fields of the volume. */
    virtual std::vector<ExpressionSample> evaluate(const std::shared_ptr<const Expression>& expression, std::uint32_t time_step,
                                                   std::span<const ReferencePoint> points, bool with_gradients) = 0;
};

/**
 * A reference point counts as inside up to this excess beyond a face, plus what the rounding of positions makes of it: points
 * that people compute on a face or edge are rounded, and both neighbours are to be found there.
 */
inline constexpr double inside_tolerance = 1e-10;

} // namespace elvis
