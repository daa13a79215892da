/**
 * @file bend_form.hpp
 * Two quadratic forms that bound the second derivatives of a mapping, by direction.
 *
 * For all points b of an element, all u and v of reference space, and all p of the world,
 *
 *     |p . D^2x(b)(u, v)| <= sqrt(p E p) N(u) N(v),   N(u)^2 = u G u.
 *
 * An element that is long and thin, and bends along its length, has a large curvature in the maximum norm of reference
 * coordinates (mapping_curvature.hpp), each of which may run along its length. By these forms, a way across the element is
 * straight, and the element bends in one direction of the world only (shaders/element/bend_form.glsl).
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <span>

namespace elvis {

/** The entries 11, 12, 13, 22, 23, 33 of a symmetric matrix. */
using SymmetricMatrix = std::array<double, 6>;

struct BendForm {
    /** G and E; zero where nothing is known. */
    SymmetricMatrix lengths{}, ways{};

    bool operator==(const BendForm&) const = default;
};

/** The second derivatives of each component of a mapping. */
using MappingHessian = std::array<SymmetricMatrix, 3>;

/**
 * One that holds for all of these, and so wherever D^2x is a mean of them, as of its Bernstein coefficients. `jacobian`: of
 * some point, entry 3i+j = dx_i/dxi_j; forms are sharper for it, but hold without it. Nothing is known if a number is not
 * finite, or the Jacobian is singular.
 */
BendForm bend_form_of(std::span<const MappingHessian> hessians, const std::array<double, 9>& jacobian);

} // namespace elvis
