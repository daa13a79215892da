#include "line_positions.hpp"

#include "cell_kind.hpp"

#include <elvis/native/space.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace elvis_vtk {

namespace {

std::vector<double> make_positions(Spacing spacing, int degree) {
    std::vector<double> x(static_cast<std::size_t>(degree) + 1);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double part = static_cast<double>(i) / degree;
        x[i] = spacing == Spacing::chebyshev ? 0.5 - 0.5 * std::cos(std::numbers::pi * part) : part;
    }
    if (spacing == Spacing::lobatto) {
        elvis::native::gauss_lobatto_legendre(x);
        for (double& one : x) {
            one = 0.5 * (1 + one);
        }
    }
    return x;
}

using Table = std::array<std::vector<double>, max_degree + 1>;

Table make_table(Spacing spacing) {
    Table table;
    for (int degree = 1; degree <= max_degree; ++degree) {
        table[static_cast<std::size_t>(degree)] = make_positions(spacing, degree);
    }
    return table;
}

} // namespace

std::span<const double> line_positions(Spacing spacing, int degree) {
    static const std::array<Table, 3> tables{make_table(Spacing::equidistant), make_table(Spacing::lobatto),
                                             make_table(Spacing::chebyshev)};
    return tables[static_cast<std::size_t>(spacing)][static_cast<std::size_t>(degree)];
}

} // namespace elvis_vtk
