/**
 * @file derivative_bounds.hpp
 * How steep and how bent a function of a native space is at most: what elvis_runtime.get_field_derivative_bounds asks for.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <memory>
#include <span>

namespace elvis::native {

/**
 * Bounds of sum_i |df/dxi_i| and of sum_ij |d^2f/dxi_i dxi_j| (all terms, mixed ones twice) over the closed reference shape;
 * the latter in pyramids times t = (1 - xi_3) / 2.
 */
struct DerivativeBound {
    double first = 0, second = 0;
};

/**
 * Bounds for the functions of one space, rounding included. They hold as well for the function that is meant by the
 * coefficients of its device form (elvis/native/conversion.hpp) after these were rounded to single precision.
 *
 * Two bounds, of which the smaller counts: the coefficients' magnitudes times what each function has at most, and in all but
 * hexahedra, quadrilaterals and `tensor` pyramids the Bernstein coefficients of the derivatives. Any thread may call; copies
 * are independent.
 */
class DerivativeBounder {
public:
    explicit DerivativeBounder(const Space& space);

    /**
     * For coefficients in the order of the space. NaN where a derivative has no bound, or none is known: fields with several
     * values at the apex of pyramids, coefficients that are not finite.
     */
    DerivativeBound operator()(std::span<const double> coefficients) const;

private:
    struct Forms;
    std::shared_ptr<const Forms> m_forms;
};

} // namespace elvis::native
