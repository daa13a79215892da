#include "point_table.hpp"

#include <algorithm>
#include <mutex>

namespace elvis_nek5000 {

namespace {

using Eigen::Index;

/** Numbers that all tables may hold: 64 MiB. */
constexpr std::size_t capacity = std::size_t{1} << 23;
/** A conversion has two or three sets of points, and one for each way to look at a face. */
constexpr std::size_t max_tables = 96;
/** Smaller sets are those of a search for a position, which come once. */
constexpr std::size_t least_points = 16;
/** Smaller grids are cheaper as single points. */
constexpr std::size_t least_grid = 16;

/** Points n of a grid's next level, whose `size` points each repeat those before but for the coordinate `direction`. */
std::size_t n_repeats(std::span<const double> points, std::size_t size, std::size_t direction) {
    const std::size_t n_points = points.size() / 3;
    const auto repeats = [&](std::size_t level) {
        const double moved = points[3 * level * size + direction];
        for (std::size_t point = 0; point < size; ++point) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double x = points[3 * (level * size + point) + axis];
                if (x != (axis == direction ? moved : points[3 * point + axis])) {
                    return false;
                }
            }
        }
        return true;
    };
    std::size_t n = 1;
    while ((n + 1) * size <= n_points && repeats(n)) {
        ++n;
    }
    return n;
}

/** The largest grid that the points begin with, the first direction fastest. */
std::array<std::size_t, 3> leading_grid(std::span<const double> points) {
    std::array<std::size_t, 3> grid{};
    std::size_t size = 1;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        grid[direction] = n_repeats(points, size, direction);
        size *= grid[direction];
    }
    return grid;
}

std::size_t product(const std::array<std::size_t, 3>& grid) { return grid[0] * grid[1] * grid[2]; }

} // namespace

PointTable::PointTable(const NodeLines& lines, std::span<const double> xi) : m_xi(xi.begin(), xi.end()) {
    std::size_t first_scattered = 0;
    std::size_t at = 0;
    const std::size_t n_points = xi.size() / 3;
    const auto end_scattered = [&] {
        if (at > first_scattered) {
            m_runs.push_back(make_scattered(lines, xi.subspan(3 * first_scattered, 3 * (at - first_scattered))));
        }
    };
    while (at < n_points) {
        const auto grid = leading_grid(xi.subspan(3 * at));
        if (product(grid) < least_grid) {
            ++at;
            continue;
        }
        end_scattered();
        m_runs.push_back(make_grid(lines, &xi[3 * at], grid));
        at += product(grid);
        first_scattered = at;
    }
    end_scattered();
}

PointTable::Matrix PointTable::tabulate(const std::vector<double>& line, std::span<const double> x) {
    std::vector<double> values(line.size());
    Matrix table(static_cast<Index>(x.size()), static_cast<Index>(line.size()));
    for (std::size_t row = 0; row < x.size(); ++row) {
        evaluate_lagrange(line, x[row], values);
        table.row(static_cast<Index>(row)) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), table.cols());
    }
    return table;
}

PointTable::Run PointTable::make_grid(const NodeLines& lines, const double* first, const std::array<std::size_t, 3>& grid) {
    Run run;
    run.n_points = static_cast<Index>(product(grid));
    std::size_t step = 1;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        std::vector<double> x;
        for (std::size_t i = 0; i < grid[direction]; ++i) {
            x.push_back(first[3 * i * step + direction]);
        }
        run.along[direction] = tabulate(lines[direction], x);
        step *= grid[direction];
    }
    return run;
}

PointTable::Run PointTable::make_scattered(const NodeLines& lines, std::span<const double> points) {
    Run run;
    const std::size_t n_points = points.size() / 3;
    run.n_points = static_cast<Index>(n_points);
    std::array<Matrix, 3> along;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        std::vector<double> x;
        for (std::size_t point = 0; point < n_points; ++point) {
            x.push_back(points[3 * point + direction]);
        }
        along[direction] = tabulate(lines[direction], x);
    }
    run.all.resize(run.n_points, along[0].cols() * along[1].cols() * along[2].cols());
    Index node = 0;
    for (Index k = 0; k < along[2].cols(); ++k) {
        for (Index j = 0; j < along[1].cols(); ++j) {
            for (Index i = 0; i < along[0].cols(); ++i, ++node) {
                run.all.col(node) = along[0].col(i).cwiseProduct(along[1].col(j)).cwiseProduct(along[2].col(k));
            }
        }
    }
    return run;
}

bool PointTable::is_of(std::span<const double> xi) const { return std::ranges::equal(m_xi, xi); }

std::size_t PointTable::size() const {
    std::size_t sum = m_xi.size();
    for (const Run& run : m_runs) {
        sum += static_cast<std::size_t>(run.all.size());
    }
    return sum;
}

void PointTable::interpolate(std::span<const double> at_nodes, double* at_points, std::size_t stride) const {
    Matrix first, second, third;
    for (const Run& run : m_runs) {
        using Target = Eigen::Map<Eigen::VectorXd, 0, Eigen::InnerStride<>>;
        Target target(at_points, run.n_points, Eigen::InnerStride<>(static_cast<Index>(stride)));
        at_points += run.n_points * static_cast<Index>(stride);
        if (run.all.size() > 0) {
            target.noalias() = run.all * Eigen::Map<const Eigen::VectorXd>(at_nodes.data(), run.all.cols());
            continue;
        }
        const auto& [a, b, c] = run.along;
        const Index n1 = b.cols(), n2 = c.cols();
        first.noalias() = a * Eigen::Map<const Matrix>(at_nodes.data(), a.cols(), n1 * n2);
        second.resize(a.rows(), b.rows() * n2);
        for (Index k = 0; k < n2; ++k) {
            second.middleCols(k * b.rows(), b.rows()).noalias() = first.middleCols(k * n1, n1) * b.transpose();
        }
        third.noalias() = Eigen::Map<const Matrix>(second.data(), a.rows() * b.rows(), n2) * c.transpose();
        target = Eigen::Map<const Eigen::VectorXd>(third.data(), third.size());
    }
}

PointTables::PointTables(const NodeSet& set) {
    for (std::size_t direction = 0; direction < 3; ++direction) {
        m_lines[direction] = nodes(set.family, set.n[direction]);
    }
}

std::shared_ptr<const PointTable> PointTables::table(std::span<const double> xi) const {
    if (xi.size() < 3 * least_points) {
        return std::make_shared<const PointTable>(m_lines, xi);
    }
    {
        const std::shared_lock lock(m_mutex);
        const auto found = std::ranges::find_if(m_tables, [&](const auto& table) { return table->is_of(xi); });
        if (found != m_tables.end()) {
            return *found;
        }
    }
    auto table = std::make_shared<const PointTable>(m_lines, xi);
    const std::unique_lock lock(m_mutex);
    if (m_tables.size() < max_tables && m_n_held + table->size() <= capacity) {
        m_n_held += table->size();
        m_tables.push_back(table);
    }
    return table;
}

} // namespace elvis_nek5000
