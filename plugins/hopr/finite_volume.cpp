#include "finite_volume.hpp"

#include <algorithm>

namespace elvis_hopr {

FiniteVolumeCells::FiniteVolumeCells(const std::vector<double>& widths) {
    double end = -1;
    for (const double width : widths) {
        end += width;
        m_ends.push_back(end);
    }
}

std::size_t FiniteVolumeCells::cell(double x) const {
    const auto found = std::ranges::upper_bound(m_ends, x);
    return std::min(static_cast<std::size_t>(found - m_ends.begin()), m_ends.size() - 1);
}

elvis::nodal::Matrix FiniteVolumeCells::at(std::span<const double> xi) const {
    const std::size_t n = m_ends.size();
    elvis::nodal::Matrix values =
        elvis::nodal::Matrix::Zero(static_cast<Eigen::Index>(xi.size() / 3), static_cast<Eigen::Index>(n * n * n));
    for (std::size_t point = 0; point < xi.size() / 3; ++point) {
        const std::size_t column = cell(xi[3 * point]) + n * (cell(xi[3 * point + 1]) + n * cell(xi[3 * point + 2]));
        values(static_cast<Eigen::Index>(point), static_cast<Eigen::Index>(column)) = 1;
    }
    return values;
}

} // namespace elvis_hopr
