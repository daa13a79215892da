/**
 * @file second_derivatives.hpp
 * The second derivatives of polynomials on a reference shape as Bernstein forms, from values at nodes.
 *
 * A shape is a product of simplices: a hexahedron that of three lines, a prism that of a triangle and a line. Values at nodes
 * become Bernstein coefficients in each factor, and derivatives are differences of these (G. Farin, Curves and Surfaces for
 * CAGD, chapters 5 and 17). On products, derivatives are raised to the degrees of the polynomial itself: then all six have the
 * same coefficients, and what is convex in all of them together is at most what it is at one of these.
 */
#pragma once

#include <elvis/element.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

class SecondDerivatives {
public:
    /** d^2/dxi_j dxi_k for (j, k) = 11, 12, 13, 22, 23, 33. */
    static constexpr std::size_t n_derivatives = 6;

    /** Hexahedron, prism or tetrahedron; orders as in elvis_element_class.geometry_order. */
    SecondDerivatives(elvis_shape shape, std::span<const std::uint32_t, 3> order);

    /** Three numbers each. */
    std::span<const double> nodes() const { return m_nodes; }
    std::size_t n_nodes() const { return m_nodes.size() / 3; }
    /** Derivatives at the shape's centroid from the polynomial's n_nodes() coefficients: three weights each. */
    std::span<const double> gradient_weights() const { return m_gradient_weights; }

    /** Numbers for each polynomial: in front its values at nodes. */
    std::size_t size() const { return m_size; }
    /** Where its coefficients begin, and those of a derivative: n_nodes() and n_coefficients(). */
    std::size_t polynomial_at() const { return m_polynomial_at; }
    std::size_t derivative_at(std::size_t derivative) const { return m_derivatives_at[derivative]; }
    std::size_t n_coefficients() const { return m_n_coefficients; }

    /** Coefficients of `count` polynomials that lie side by side, from their values; then, of these, those of derivatives. */
    template <std::size_t count> void interpolate(double* numbers) const {
        for (const Step& step : m_interpolation) {
            apply<count>(step, numbers);
        }
    }
    template <std::size_t count> void differentiate(double* numbers) const {
        for (const Step& step : m_differentiation) {
            apply<count>(step, numbers);
        }
    }

private:
    struct Entry {
        std::size_t row, column;
        double value;
    };
    /** A linear map along one factor. */
    struct Map {
        std::size_t n_rows = 0, n_columns = 0;
        std::vector<Entry> entries;
    };
    /** `n_before`, `n_after`: coefficients in the factors before and after that one. */
    struct Step {
        std::size_t map, source, target, n_before, n_after;
    };
    struct Factor;
    class Planner;

    template <std::size_t count> void apply(const Step& step, double* numbers) const;
    void place_nodes(std::span<const Factor> factors);

    std::vector<double> m_nodes, m_gradient_weights;
    std::vector<Map> m_maps;
    std::vector<Step> m_interpolation, m_differentiation;
    std::array<std::size_t, n_derivatives> m_derivatives_at{};
    std::size_t m_polynomial_at = 0, m_n_coefficients = 0, m_size = 0;
};

template <std::size_t count> void SecondDerivatives::apply(const Step& step, double* numbers) const {
    const Map& map = m_maps[step.map];
    const std::size_t length = step.n_after * count;
    for (std::size_t before = 0; before < step.n_before; ++before) {
        const double* const source = numbers + step.source * count + before * map.n_columns * length;
        double* const target = numbers + step.target * count + before * map.n_rows * length;
        std::fill_n(target, map.n_rows * length, 0.0);
        for (const Entry& entry : map.entries) {
            const double* const in = source + entry.column * length;
            double* const out = target + entry.row * length;
            for (std::size_t k = 0; k < length; ++k) {
                out[k] += entry.value * in[k];
            }
        }
    }
}

} // namespace elvis
