/**
 * @file derivative_weights.hpp
 * How steep and how bent each function of a device space is at most.
 */
#pragma once

#include <elvis/native/derivative_bounds.hpp>
#include <elvis/native/device_space.hpp>

#include <span>
#include <vector>

namespace elvis::native::device {

/**
 * One pair of weights for each function of the space, in the order of the record, from suprema of their one-dimensional
 * factors. For a sum f of these functions with coefficients c, sum_ij |d_ij f| <= sum_m |c_m| second_m. Second derivatives may
 * be `apex_weighted`, since that of t x1/t x2/t at the apex of a pyramid is not bounded.
 *
 * A factor that depends on x/t, times t^k, is a homogeneous function, and so are its derivatives, with k less by one each:
 * d/dx (t^k g(x/t)) = t^(k-1) g'(u), and along a direction in which x grows by 1/2 and t falls by 1/2,
 * t^(k-1) ((1 + u) g'(u) - k g(u)) / 2. What remains of the powers of t goes to the next factor, where it makes up for the
 * growth of the Jacobi polynomials. Every one-dimensional function whose supremum is wanted is a polynomial of known degree d;
 * max |p| <= max_j |p(cos(pi j / m))| / cos(pi d / (2 m)) over j = 0 .. m > d (Ehlich and Zeller 1964).
 */
class DerivativeWeights {
public:
    explicit DerivativeWeights(const DeviceSpace& space, SecondDerivatives second_derivatives = SecondDerivatives::plain);

    /** For device coefficients; an infinite number where a function with a coefficient has no bound. */
    DerivativeBound bound(std::span<const double> coefficients) const;

    /** Infinite where the function's derivatives are not bounded (apex of a pyramid). */
    const std::vector<double>& first() const { return m_first; }
    const std::vector<double>& second() const { return m_second; }

private:
    void add(double first, double second);

    std::vector<double> m_first, m_second;
    /** The same with 0 in place of infinity, and the functions where that is so. */
    std::vector<double> m_finite_first, m_finite_second;
    std::vector<std::size_t> m_without_first, m_without_second;
    double m_largest_first = 0, m_largest_second = 0;
};

} // namespace elvis::native::device
