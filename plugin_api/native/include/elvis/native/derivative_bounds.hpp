/**
 * @file derivative_bounds.hpp
 * How steep and how bent a function of a native space is at most: what elvis_runtime.get_field_derivative_bounds and
 * elvis_apex_bounds.get_field_apex_bounds ask for.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <memory>
#include <span>

namespace elvis::native {

/** What is bounded of second derivatives: in pyramids these, or t times these, t = (1 - xi_3) / 2; elsewhere these. */
enum class SecondDerivatives { plain, apex_weighted };

/** Bounds of sum_i |df/dxi_i| and of sum_ij |d^2f/dxi_i dxi_j| (all terms, mixed ones twice) over the closed reference shape.
 */
struct DerivativeBound {
    double first = 0, second = 0;
};

/**
 * Bounds for the functions of one space, rounding included. They hold as well for the function that is meant by the
 * coefficients of its device form (elvis/native/conversion.hpp) after these were rounded to single precision.
 *
 * Two bounds, of which the smaller counts: the coefficients' magnitudes times what each function has at most, and in prisms,
 * triangles and tetrahedra the Bernstein coefficients of the derivatives, `apex_weighted` in pyramids but `tensor` ones, too.
 * Any thread may call; copies are independent.
 */
class DerivativeBounder {
public:
    explicit DerivativeBounder(const Space& space, SecondDerivatives second = SecondDerivatives::plain);

    /**
     * For coefficients in the order of the space. NaN where a derivative has no bound, or none is known: `plain` second
     * derivatives at the apex of pyramids (but those of `orthogonal` basis), fields with several values there, coefficients
     * that are not finite.
     */
    DerivativeBound operator()(std::span<const double> coefficients) const;

private:
    struct Forms;
    std::shared_ptr<const Forms> m_forms;
};

} // namespace elvis::native
