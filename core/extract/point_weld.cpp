#include <core/extract/point_weld.hpp>

#include <cmath>

namespace elvis {

PointWeld::PointWeld(double most_distance) : m_side(8 * most_distance) {}

std::uint64_t PointWeld::key(const Cell& cell) {
    std::uint64_t mixed = 0;
    for (const std::int64_t number : cell) {
        // The constant is 2^64 over the golden ratio, as in Fibonacci hashing.
        mixed = (mixed ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15u;
        mixed ^= mixed >> 29;
    }
    return mixed;
}

std::uint32_t PointWeld::find_or_add(const Vector3& position, double distance, double level) {
    Cell lower{}, upper{}, own{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        lower[axis] = static_cast<std::int64_t>(std::floor((position[axis] - distance) / m_side));
        upper[axis] = static_cast<std::int64_t>(std::floor((position[axis] + distance) / m_side));
        own[axis] = static_cast<std::int64_t>(std::floor(position[axis] / m_side));
    }
    std::uint32_t nearest = none;
    double least = distance;
    for (std::int64_t k = lower[2]; k <= upper[2]; ++k) {
        for (std::int64_t j = lower[1]; j <= upper[1]; ++j) {
            for (std::int64_t i = lower[0]; i <= upper[0]; ++i) {
                const auto found = m_first.find(key({i, j, k}));
                for (std::uint32_t id = found == m_first.end() ? none : found->second; id != none; id = m_next[id]) {
                    const double away = length(minus(m_positions[id], position));
                    if (away <= least) {
                        least = away;
                        nearest = id;
                    }
                }
            }
        }
    }
    if (nearest != none) {
        return nearest;
    }
    const auto id = static_cast<std::uint32_t>(m_positions.size());
    m_positions.push_back(position);
    m_levels.push_back(level);
    const auto [place, is_new] = m_first.try_emplace(key(own), id);
    m_next.push_back(is_new ? none : place->second);
    place->second = id;
    return id;
}

} // namespace elvis
