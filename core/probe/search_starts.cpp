#include <core/probe/reference_shape.hpp>
#include <core/probe/search_starts.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

// So many targets pay for the evaluation at one point.
constexpr double targets_a_point = 4;
constexpr std::size_t most_points = 9;
// Each from the lattice's point next to where the one before led.
constexpr int n_steps = 3;

} // namespace

SearchStarts::SearchStarts(elvis_shape shape, const MappingFunction& mapping, std::size_t n_targets) : m_shape(shape) {
    const auto size = static_cast<std::size_t>(std::cbrt(static_cast<double>(n_targets) / targets_a_point));
    m_size = std::min(size, most_points);
    if (m_size < 2)
        return;
    for (std::size_t k = 0; k < m_size; ++k)
        for (std::size_t j = 0; j < m_size; ++j)
            for (std::size_t i = 0; i < m_size; ++i) {
                const Vector3 xi = project_into_shape(shape, {coordinate(i), coordinate(j), coordinate(k)});
                m_points.insert(m_points.end(), xi.begin(), xi.end());
            }
    m_positions.resize(m_points.size());
    m_inverses.resize(3 * m_points.size());
    mapping(m_points, m_positions, m_inverses);
    for (std::size_t point = 0; point < m_points.size() / 3; ++point) {
        std::array<double, 9> matrix{};
        std::copy_n(&m_inverses[9 * point], 9, matrix.begin());
        std::ranges::copy(invert_matrix(matrix), &m_inverses[9 * point]);
    }
}

double SearchStarts::coordinate(std::size_t index) const {
    return 2.0 * static_cast<double>(index) / static_cast<double>(m_size - 1) - 1;
}

std::size_t SearchStarts::index(double xi) const {
    return static_cast<std::size_t>(std::lround((xi + 1) / 2 * static_cast<double>(m_size - 1)));
}

Vector3 SearchStarts::start(const Vector3& target) const {
    Vector3 xi = reference_centroid(m_shape);
    for (int step = 0; m_size >= 2 && step < n_steps; ++step) {
        const std::size_t point = index(xi[0]) + m_size * (index(xi[1]) + m_size * index(xi[2]));
        const double* const position = &m_positions[3 * point];
        const double* const inverse = &m_inverses[9 * point];
        const Vector3 way{target[0] - position[0], target[1] - position[1], target[2] - position[2]};
        const Vector3 next = plus(Vector3{m_points[3 * point], m_points[3 * point + 1], m_points[3 * point + 2]},
                                  {dot(inverse, way), dot(inverse + 3, way), dot(inverse + 6, way)});
        if (!std::isfinite(next[0] + next[1] + next[2]))
            break;
        xi = project_into_shape(m_shape, next);
    }
    return xi;
}

} // namespace elvis
