/**
 * @file evaluate.hpp
 * Evaluates expressions on the CPU in double precision.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/expression/expression.hpp>

#include <array>
#include <vector>

namespace elvis {

/**
 * What an element gives at one reference point. Matrices row by row: jacobian[3 * i + j] = dx_i/dxi_j, mapping_hessian[9 * i +
 * 3 * j + l] = d2x_i/dxi_j dxi_l, hessian[3 * j + l] = d2f/dxi_j dxi_l. Only what an expression needs is asked for.
 */
class ExpressionPoint {
public:
    virtual ~ExpressionPoint() = default;
    virtual Vector3 position() = 0;
    virtual std::array<double, 9> jacobian() = 0;
    virtual std::array<double, 27> mapping_hessian() = 0;
    virtual double value(std::uint32_t field, std::uint32_t component) = 0;
    /** By reference coordinates. */
    virtual Vector3 gradient(std::uint32_t field, std::uint32_t component) = 0;
    virtual std::array<double, 9> hessian(std::uint32_t field, std::uint32_t component) = 0;
    /** Polynomial order in the element; any_field: the largest of all fields. */
    virtual double order(std::uint32_t field) = 0;
    virtual double element_number() = 0;
};

double evaluate(const Expression& expression, ExpressionPoint& point);

/** Of all nodes that the value needs, by number; zero of others. */
std::vector<double> node_values(const Expression& expression, ExpressionPoint& point);

struct ValueAndGradient {
    double value = 0;
    Vector3 gradient{};
};

/** The gradient by reference coordinates (by world coordinates for implicit expressions). Needs expression.gradient(). */
ValueAndGradient evaluate_gradient(const Expression& expression, ExpressionPoint& point);

/** An implicit expression at a point of space. */
ValueAndGradient evaluate_implicit(const Expression& expression, const Vector3& x);

/** Inverse of a matrix given row by row. */
std::array<double, 9> inverse3(const std::array<double, 9>& matrix);

} // namespace elvis
