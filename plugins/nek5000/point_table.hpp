/**
 * @file point_table.hpp
 * Interpolation to sets of points. The host asks for the same sets again and again, so that what depends on them alone is kept.
 */
#pragma once

#include "nodal_basis.hpp"

#include <Eigen/Core>

#include <memory>
#include <shared_mutex>

namespace elvis_nek5000 {

/** Nodes of each direction. */
using NodeLines = std::array<std::vector<double>, 3>;

/**
 * Values at points from values at nodes. Points that form a grid, as those of quadrature do, are reached by one direction after
 * the other: n^4 operations for n^3 points and nodes; others by one matrix.
 */
class PointTable {
public:
    PointTable(const NodeLines& lines, std::span<const double> xi);

    bool is_of(std::span<const double> xi) const;
    /** Numbers that it holds. */
    std::size_t size() const;
    /** One component: values at all nodes; a value each `stride` numbers for the points. */
    void interpolate(std::span<const double> at_nodes, double* at_points, std::size_t stride) const;

private:
    using Matrix = Eigen::MatrixXd;

    /** Points in a row. */
    struct Run {
        Eigen::Index n_points = 0;
        /** Of a grid, for each direction: rows are points, columns nodes. */
        std::array<Matrix, 3> along;
        /** Of other points. */
        Matrix all;
    };

    static Matrix tabulate(const std::vector<double>& line, std::span<const double> x);
    static Run make_grid(const NodeLines& lines, const double* first, const std::array<std::size_t, 3>& grid);
    static Run make_scattered(const NodeLines& lines, std::span<const double> points);

    std::vector<double> m_xi;
    std::vector<Run> m_runs;
};

/** Any thread may ask. */
class PointTables {
public:
    /** For nodes of this set alone. */
    explicit PointTables(const NodeSet& set);

    std::shared_ptr<const PointTable> table(std::span<const double> xi) const;

private:
    NodeLines m_lines;
    mutable std::shared_mutex m_mutex;
    mutable std::vector<std::shared_ptr<const PointTable>> m_tables;
    mutable std::size_t m_n_held = 0;
};

} // namespace elvis_nek5000
