/**
 * @file newton.hpp
 * Inverse of a mapping on the CPU by Newton's method.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/probe/point_evaluator.hpp>
#include <elvis/element.h>

#include <functional>
#include <span>
#include <vector>

namespace elvis {

/** Positions (3 numbers a point) and, unless the span is empty, Jacobians (9 a point, entry 3i+j = dx_i/dxi_j) at points. */
using MappingFunction =
    std::function<void(std::span<const double> xi, std::span<double> positions, std::span<double> jacobians)>;

/**
 * The reference point of `target` in one element. The mapping is evaluated inside the closed shape only, the one place where
 * it is known to be one to one: a prediction outside is moved into the shape first, and the linear model from there says on
 * which side of a face the target lies. Several starts: the centroid, then points whose images come closest to the target.
 */
Inversion invert_mapping(elvis_shape shape, const MappingFunction& mapping, const Vector3& target);

/** The same of several targets in one element, whose points are evaluated together. */
std::vector<Inversion> invert_mapping(elvis_shape shape, const MappingFunction& mapping, std::span<const Vector3> targets);

/** Of a 3 x 3 matrix, row by row; infinities or NaN if it is singular. */
std::array<double, 9> invert_matrix(const std::array<double, 9>& matrix);

/** Gradients in xi (three numbers each) become gradients in x: grad_x = J^-T grad_xi. */
void to_world_gradients(const std::array<double, 9>& jacobian, std::span<double> gradients);

} // namespace elvis
