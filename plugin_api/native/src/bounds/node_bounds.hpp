/**
 * @file node_bounds.hpp
 * How far a polynomial over the collapsed cube reaches beyond its values at nodes.
 *
 * Bernstein coefficients of high order can be thousands of times as large as all values. At the nodes cos(pi j / m),
 * j = 0 .. m, of one direction a polynomial of degree d < m has |p| <= max_j |p_j| / cos(pi d / (2 m)) (Ehlich and Zeller
 * 1964), and over a grid of three directions the factors multiply. With three nodes a degree, m = 3 d, that is 1.54 at most.
 */
#pragma once

#include "derivative_forms.hpp"

#include <elvis/native/space.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace elvis::native {

class NodeBounds {
public:
    /** Of forms of these sizes. */
    explicit NodeBounds(const Sizes& sizes);

    std::size_t workspace_size() const { return m_workspace_size; }

    /**
     * A range of the form's polynomial, whose coefficients lie in `coefficients` and are off by `error` at most. None where a
     * few values tell that `coefficients` is about as narrow.
     */
    std::optional<Range> operator()(const double* form, const Range& coefficients, double error, double* workspace) const;

private:
    /** Bernstein polynomials of a direction at nodes: one row a node. */
    struct Direction {
        std::size_t n_nodes = 0, n_coefficients = 0;
        std::vector<double> values;
    };
    using Grid = std::array<Direction, 3>;

    static Grid grid(const Sizes& sizes, const std::array<std::size_t, 3>& n_intervals);
    static std::size_t workspace_of(const Grid& grid);
    /** Smallest and largest value at the nodes. */
    static Range seen(const Grid& grid, const double* form, double* workspace);

    /** Ends and middles; and nodes that bound. */
    Grid m_few, m_many;
    double m_growth = 1, m_rounding = 0;
    std::size_t m_workspace_size = 0;
};

} // namespace elvis::native
