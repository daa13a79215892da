/**
 * @file halving.hpp
 * Bernstein forms over a part of the collapsed cube, halved along one direction by de Casteljau's algorithm (Farin, Curves and
 * Surfaces for CAGD, 4.2): the coefficients of either half bound the function there, those at the corners are its values.
 */
#pragma once

#include "derivative_forms.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace elvis::native {

/**
 * Halvings along a direction: places of corners stay exact in double precision, since xi of eta with 16 bits each is a product
 * of at most three such numbers.
 */
inline constexpr std::uint32_t max_depth = 16;

/** A part of the collapsed cube: along each direction halved `depth` times, the `index`-th of the parts. */
struct CubePart {
    std::array<std::uint32_t, 3> index{}, depth{};

    /** Collapsed coordinates of a corner: bit d of `corner` is set at the upper end of direction d. */
    Point corner(unsigned corner) const;
    /** One half along a direction. */
    CubePart half(std::size_t direction, bool is_upper) const;
};

/** Where directions and corners lie in the storage of a form. */
class FormLayout {
public:
    FormLayout(Shape shape, const Sizes& sizes);

    std::size_t size() const { return product(m_sizes); }
    /** Place of the coefficient at a corner, bits as in CubePart::corner. */
    std::size_t at_corner(unsigned corner) const { return m_corners[corner]; }
    /** Coefficients along a direction. */
    std::size_t n_along(std::size_t direction) const { return m_sizes[m_places[direction]]; }

    /** Largest step between neighbouring coefficients along a direction. */
    double variation(std::span<const double> form, std::size_t direction) const;
    /** Turns `form` into its upper half along a direction, and writes the lower half. Each coefficient is rounded at most
     * n_along times. */
    void halve(std::span<double> form, std::span<double> lower, std::size_t direction) const;

private:
    std::size_t stride(std::size_t direction) const;

    Sizes m_sizes, m_places;
    std::array<std::size_t, 8> m_corners{};
};

} // namespace elvis::native
