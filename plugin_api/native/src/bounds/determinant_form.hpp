/**
 * @file determinant_form.hpp
 * Bernstein form of det (a, b, c), the columns being Bernstein polynomials.
 *
 * With the binomials put into the coefficients, products of Bernstein polynomials are convolutions (Farin, Curves and Surfaces
 * for CAGD). A coefficient of the product is a mean of products of coefficients with weights that are positive and sum to 1,
 * so that errors stay as small as those of single products.
 */
#pragma once

#include "derivative_forms.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace elvis::native {

class DeterminantForm {
public:
    explicit DeterminantForm(const std::array<DerivativeForms::Column, 3>& columns);

    const Sizes& sizes() const { return m_sizes; }
    std::size_t size() const { return product(m_sizes); }
    std::size_t workspace_size() const { return m_workspace_size; }

    /**
     * Times the permanent of the largest magnitudes of the columns' coefficients: a bound of what the rounding of `evaluate`
     * changes in any coefficient.
     */
    double gamma() const { return m_gamma; }

    /** columns[3 * j + i]: component i of column j, interleaved; result[k * lanes + lane]. */
    template <std::size_t lanes>
    void evaluate(const std::array<const double*, 9>& columns, double* workspace, double* result) const;

private:
    struct Factor {
        std::size_t size = 0;
        /** Product of the binomials of each coefficient. */
        std::vector<double> binomials;
        /** Place of the coefficient's contribution in a product. */
        std::vector<std::size_t> in_cross, in_result;
    };

    Sizes m_sizes{}, m_cross_sizes{};
    std::array<Factor, 3> m_columns;
    Factor m_cross;
    /** 1 / binomials of the result. */
    std::vector<double> m_scale;
    std::size_t m_workspace_size = 0;
    double m_gamma = 0;
};

/** The determinant of the magnitudes with plus signs throughout; of a matrix by columns or by rows. */
double permanent(const std::array<double, 9>& m);

/**
 * Bound of |det (A + dA) - fl(det A)| from magnitudes |A| + |dA| and errors |dA|, entry 3 j + i being component i of column j;
 * gamma as in Higham for the roundings of a product of three. |prod (a + da) - prod a| <= prod (|a| + |da|) - prod |a|, which
 * is summed over the six products without cancellation. With the largest magnitudes of the coefficients of forms, it bounds the
 * errors of the product's coefficients.
 */
double determinant_error(const std::array<double, 9>& magnitudes, const std::array<double, 9>& errors, double gamma);

template <std::size_t lanes>
[[gnu::always_inline]] inline void DeterminantForm::evaluate(const std::array<const double*, 9>& columns, double* workspace,
                                                             double* result) const {
    std::array<double*, 9> scaled{};
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) {
            scaled[3 * j + i] = workspace;
            for (std::size_t k = 0; k < m_columns[j].size; ++k, workspace += lanes)
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    workspace[lane] = m_columns[j].binomials[k] * columns[3 * j + i][k * lanes + lane];
        }
    // b x c
    double* const cross = workspace;
    std::fill_n(cross, 3 * m_cross.size * lanes, 0.0);
    for (std::size_t k = 0; k < m_columns[1].size; ++k) {
        const double* const b0 = scaled[3] + k * lanes;
        const double* const b1 = scaled[4] + k * lanes;
        const double* const b2 = scaled[5] + k * lanes;
        for (std::size_t m = 0; m < m_columns[2].size; ++m) {
            const double* const c0 = scaled[6] + m * lanes;
            const double* const c1 = scaled[7] + m * lanes;
            const double* const c2 = scaled[8] + m * lanes;
            double* const out = cross + 3 * (m_columns[1].in_cross[k] + m_columns[2].in_cross[m]) * lanes;
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                out[lane] += b1[lane] * c2[lane] - b2[lane] * c1[lane];
                out[lanes + lane] += b2[lane] * c0[lane] - b0[lane] * c2[lane];
                out[2 * lanes + lane] += b0[lane] * c1[lane] - b1[lane] * c0[lane];
            }
        }
    }
    std::fill_n(result, size() * lanes, 0.0);
    for (std::size_t k = 0; k < m_columns[0].size; ++k) {
        const double* const a0 = scaled[0] + k * lanes;
        const double* const a1 = scaled[1] + k * lanes;
        const double* const a2 = scaled[2] + k * lanes;
        for (std::size_t m = 0; m < m_cross.size; ++m) {
            const double* const n = cross + 3 * m * lanes;
            double* const out = result + (m_columns[0].in_result[k] + m_cross.in_result[m]) * lanes;
            for (std::size_t lane = 0; lane < lanes; ++lane)
                out[lane] += a0[lane] * n[lane] + a1[lane] * n[lanes + lane] + a2[lane] * n[2 * lanes + lane];
        }
    }
    for (std::size_t k = 0; k < size(); ++k)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            result[k * lanes + lane] *= m_scale[k];
}

} // namespace elvis::native
