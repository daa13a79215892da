#include "node_bounds.hpp"

#include "numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elvis::native {
namespace {

constexpr std::size_t nodes_a_degree = 3;
/** Over the spread of a few values: of coefficients that are less spread out, nodes would tell little. */
constexpr double wide = 3;

/** All Bernstein polynomials of degree `degree` at z. */
void bernstein_values(std::size_t degree, long double z, double* values) {
    const long double right = (1 + z) / 2, left = (1 - z) / 2;
    std::vector<long double> b(degree + 1, 0);
    b[0] = 1;
    for (std::size_t n = 1; n <= degree; ++n)
        for (std::size_t k = n + 1; k-- > 0;)
            b[k] = left * b[k] + (k > 0 ? right * b[k - 1] : 0);
    std::transform(b.begin(), b.end(), values, [](long double value) { return static_cast<double>(value); });
}

/** Along the slowest of the directions that are left: blocks of `block` numbers, one a coefficient, to one a node. */
void sum_along(const double* values, std::size_t n_nodes, std::size_t n_coefficients, const double* in, std::size_t block,
               double* out) {
    std::fill_n(out, n_nodes * block, 0.0);
    for (std::size_t node = 0; node < n_nodes; ++node)
        for (std::size_t k = 0; k < n_coefficients; ++k) {
            const double weight = values[node * n_coefficients + k];
            for (std::size_t i = 0; i < block; ++i)
                out[node * block + i] += weight * in[k * block + i];
        }
}

} // namespace

NodeBounds::Grid NodeBounds::grid(const Sizes& sizes, const std::array<std::size_t, 3>& n_intervals) {
    Grid grid;
    for (std::size_t place = 0; place < 3; ++place) {
        Direction& direction = grid[place];
        direction.n_nodes = n_intervals[place] + 1;
        direction.n_coefficients = sizes[place];
        direction.values.resize(direction.n_nodes * sizes[place]);
        for (std::size_t node = 0; node < direction.n_nodes; ++node) {
            const auto share =
                static_cast<long double>(node) / static_cast<long double>(std::max<std::size_t>(n_intervals[place], 1));
            bernstein_values(sizes[place] - 1, std::cos(std::numbers::pi_v<long double> * share),
                             direction.values.data() + node * sizes[place]);
        }
    }
    return grid;
}

std::size_t NodeBounds::workspace_of(const Grid& grid) {
    return grid[1].n_coefficients * grid[2].n_coefficients + grid[1].n_nodes * grid[2].n_coefficients + grid[2].n_nodes;
}

NodeBounds::NodeBounds(const Sizes& sizes) {
    std::array<std::size_t, 3> few{}, many{};
    for (std::size_t place = 0; place < 3; ++place) {
        const std::size_t degree = sizes[place] - 1;
        few[place] = std::min<std::size_t>(degree, 2);
        many[place] = nodes_a_degree * degree;
        const double angle = degree == 0 ? 0 : std::numbers::pi / static_cast<double>(2 * nodes_a_degree);
        // An angle of a node, rounded, counts as nothing beside the last digits.
        m_growth *= (1 + 1e-12) / std::cos(angle);
        // Products and sums of a direction, and its table. Values of Bernstein polynomials are not negative and sum to 1.
        m_rounding += 2 * static_cast<double>(sizes[place] + 4) * unit;
    }
    m_few = grid(sizes, few);
    m_many = grid(sizes, many);
    m_workspace_size = std::max(workspace_of(m_few), workspace_of(m_many));
}

Range NodeBounds::seen(const Grid& grid, const double* form, double* workspace) {
    const auto& [outer, mid, inner] = grid;
    const std::size_t plane = mid.n_coefficients * inner.n_coefficients, line = inner.n_coefficients;
    double* const planes = workspace;
    double* const lines = planes + plane;
    double* const points = lines + mid.n_nodes * line;
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < outer.n_nodes; ++i) {
        sum_along(outer.values.data() + i * outer.n_coefficients, 1, outer.n_coefficients, form, plane, planes);
        sum_along(mid.values.data(), mid.n_nodes, mid.n_coefficients, planes, line, lines);
        for (std::size_t j = 0; j < mid.n_nodes; ++j) {
            sum_along(inner.values.data(), inner.n_nodes, inner.n_coefficients, lines + j * line, 1, points);
            const auto [least, most] = std::minmax_element(points, points + inner.n_nodes);
            range = {std::min(range.lower, *least), std::max(range.upper, *most)};
        }
    }
    return range;
}

std::optional<Range> NodeBounds::operator()(const double* form, const Range& coefficients, double error,
                                            double* workspace) const {
    const Range few = seen(m_few, form, workspace);
    if (!(coefficients.upper - coefficients.lower > wide * (few.upper - few.lower)))
        return std::nullopt;
    const Range many = seen(m_many, form, workspace);
    // From the middle of the range, of which the polynomial with coefficients as they were computed has this distance at most.
    const double off = m_rounding * std::max(std::abs(coefficients.lower), std::abs(coefficients.upper));
    const double middle = 0.5 * (many.lower + many.upper),
                 reach = m_growth * (0.5 * (many.upper - many.lower) + 2 * off) + error;
    return Range{middle - reach, middle + reach};
}

} // namespace elvis::native
