/**
 * @file pyramid_bounds.hpp
 * Bounds of derivatives in pyramids from Bernstein coefficients: sharper than weights for smooth fields.
 */
#pragma once

#include "derivative_forms.hpp"

#include <elvis/native/derivative_bounds.hpp>

#include <span>

namespace elvis::native {

/**
 * The first derivatives f_j = df/dxi_j are polynomials in collapsed coordinates (derivative_forms.hpp), and so are t times the
 * second ones, t = (1 - eta_3)/2: with r = (1 + eta)/2,
 *
 *   t f_1j = df_j/deta_1     t f_2j = df_j/deta_2     t f_33 = t df_3/deta_3 + r_1 df_3/deta_1 + r_2 df_3/deta_2
 *
 * Each is at most its largest Bernstein coefficient.
 */
class PyramidBounds {
public:
    /** Not for other shapes, nor for `tensor` spaces, whose derivatives are no polynomials. */
    static bool has_bounds(const Space& space);
    /** Of a space that has bounds. */
    explicit PyramidBounds(const Space& space) : m_forms(space) {}

    /** For coefficients in the order of the space. */
    DerivativeBound bound(std::span<const double> coefficients) const;

private:
    DerivativeForms m_forms;
};

} // namespace elvis::native
