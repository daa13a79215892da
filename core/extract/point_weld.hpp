/**
 * @file point_weld.hpp
 * Which points of different elements are the same.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace elvis {

/** Points that are nearer to each other than a distance have one number. */
class PointWeld {
public:
    /** No distance is larger. */
    explicit PointWeld(double most_distance);

    /** The number of the point there; a new one if there is none. `level` is kept with new ones. */
    std::uint32_t find_or_add(const Vector3& position, double distance, double level);

    /** Of whoever came first. */
    const Vector3& position(std::uint32_t id) const { return m_positions[id]; }
    double level(std::uint32_t id) const { return m_levels[id]; }
    std::size_t size() const { return m_positions.size(); }

private:
    using Cell = std::array<std::int64_t, 3>;
    static constexpr std::uint32_t none = 0xffffffffu;
    static std::uint64_t key(const Cell& cell);

    double m_side;
    std::vector<Vector3> m_positions;
    std::vector<double> m_levels;
    /** The next point of the same key. */
    std::vector<std::uint32_t> m_next;
    std::unordered_map<std::uint64_t, std::uint32_t> m_first;
};

} // namespace elvis
