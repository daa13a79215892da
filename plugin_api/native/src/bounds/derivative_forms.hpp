/**
 * @file derivative_forms.hpp
 * The columns dx/dxi_1, dx/dxi_2, dx/dxi_3 of a mapping's Jacobian as Bernstein polynomials in collapsed coordinates.
 *
 * In every space of the native volume they are polynomials in eta, although the collapse eta(xi) is singular: with
 * l = (1 - z)/2, r = (1 + z)/2 of the direction in the index,
 *
 *   hexahedron    d/dxi_j = d/deta_j
 *   prism         d/dxi1 = d1                 d/dxi2 = d/deta2               d/dxi3 = d/deta3 + r1 d1          d1 = d/deta1 /
 * l3 pyramid       d/dxi1 = d1                 d/dxi2 = d2                    d/dxi3 = d/deta3 + r1 d1 + r2 d2  d2 = d/deta2 /
 * l3 tetrahedron   d/dxi1 = d1 = d/deta1/l2/l3 d/dxi2 = d2 + r1 d1            d/dxi3 = d/deta3 + r1 d1 + r2 d2
 *
 * (Karniadakis & Sherwin, 4.1.3). The divisions leave no remainder, since every mode that depends on a collapsed direction
 * holds the factors l; f = l g means g_k = f_k n/(n-k) for the Bernstein coefficients of f of degree n. In prisms and
 * tetrahedra the columns are polynomials in xi of smaller total degree than x, and their forms are reduced to what degree that
 * leaves in eta.
 */
#pragma once

#include "bernstein_tables.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace elvis::native {

/** Number of Bernstein coefficients by place in storage: outer, mid, inner. */
using Sizes = std::array<std::size_t, 3>;
inline std::size_t product(const Sizes& n) { return n[0] * n[1] * n[2]; }

/** Place in storage of each direction of a shape. */
Sizes storage_places(Shape shape);

class DerivativeForms {
public:
    /** A column of the Jacobian: one form a component. */
    struct Column {
        Sizes sizes;
        /** Of its first coefficient among the numbers of a component. */
        std::size_t offset;
        /**
         * Times the weighted sum of the coefficients' magnitudes (`magnitude` below): a bound of the computed Bernstein
         * coefficients, and of their difference from the exact ones.
         */
        double bound, error;
    };

    explicit DerivativeForms(const Space& space);

    const std::array<Column, 3>& columns() const { return m_columns; }
    std::size_t n_modes() const { return m_tables.weights.size(); }
    /** Numbers a component that `evaluate` fills, the columns among them. */
    std::size_t size() const { return m_size; }
    std::size_t workspace_size() const { return m_tables.workspace_size(); }

    /** One component of `lanes` elements at once, interleaved: coefficients[mode * lanes + lane], forms[k * lanes + lane]. */
    template <std::size_t lanes>
    void evaluate(const double* coefficients, double* workspace, double* forms, double* magnitude) const;

private:
    /** Linear map along one direction. */
    struct Entry {
        std::size_t row, column;
        double value;
    };
    struct Matrix {
        std::size_t n_rows = 0;
        std::vector<Entry> entries;
    };
    struct Step {
        Sizes from;
        std::size_t place, n_rows, source, target;
        std::vector<Entry> entries;
    };
    class Planner;

    BernsteinTables m_tables;
    std::vector<Step> m_steps;
    std::array<Column, 3> m_columns{};
    std::size_t m_size = 0;
};

template <std::size_t lanes>
[[gnu::always_inline]] inline void DerivativeForms::evaluate(const double* coefficients, double* workspace, double* forms,
                                                             double* magnitude) const {
    std::fill_n(magnitude, lanes, 0.0);
    for (std::size_t mode = 0; mode < m_tables.weights.size(); ++mode)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double c = coefficients[mode * lanes + lane];
            magnitude[lane] += (c < 0 ? -c : c) * m_tables.weights[mode];
        }
    m_tables.transform<lanes>(coefficients, workspace, forms);
    std::fill_n(forms + m_tables.size() * lanes, (m_size - m_tables.size()) * lanes, 0.0);
    for (const Step& step : m_steps) {
        std::size_t n_blocks = 1;
        for (std::size_t place = 0; place < step.place; ++place)
            n_blocks *= step.from[place];
        std::size_t block = lanes;
        for (std::size_t place = step.place + 1; place < 3; ++place)
            block *= step.from[place];
        for (std::size_t i = 0; i < n_blocks; ++i) {
            const double* const source = forms + step.source * lanes + i * step.from[step.place] * block;
            double* const target = forms + step.target * lanes + i * step.n_rows * block;
            for (const Entry& entry : step.entries) {
                const double* const in = source + entry.column * block;
                double* const out = target + entry.row * block;
                for (std::size_t k = 0; k < block; k += lanes)
                    for (std::size_t lane = 0; lane < lanes; ++lane)
                        out[k + lane] += entry.value * in[k + lane];
            }
        }
    }
}

} // namespace elvis::native
