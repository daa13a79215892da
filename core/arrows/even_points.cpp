#include <core/arrows/even_points.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>
#include <utility>

namespace elvis {

namespace {

/** Points by cubic cells of a given size. */
class Cells {
public:
    explicit Cells(double size) : m_size(size) {}

    void add(const Vector3& point, std::size_t index) { m_cells[cell_of(point)].push_back(index); }

    /** Calls look(index) of all points that may be nearer than the size. */
    template <class Look> void near(const Vector3& point, const Look& look) const {
        const Cell cell = cell_of(point);
        for (std::int64_t i = 0; i < 27; ++i) {
            const auto found = m_cells.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
            if (found != m_cells.end()) {
                std::ranges::for_each(found->second, look);
            }
        }
    }

private:
    using Cell = std::array<std::int64_t, 3>;
    Cell cell_of(const Vector3& point) const {
        Cell cell{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cell[axis] = static_cast<std::int64_t>(std::floor(point[axis] / m_size));
        }
        return cell;
    }

    double m_size;
    std::map<Cell, std::vector<std::size_t>> m_cells;
};

class Front {
public:
    Front(const std::vector<Vector3>& candidates, double distance)
        : m_candidates(candidates), m_distance(distance), m_by_place(2 * distance), m_chosen_by_place(distance),
          m_nearest(candidates.size(), {2 * distance, 2 * distance}) {
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            m_by_place.add(candidates[i], i);
        }
    }

    bool has_room(std::size_t candidate) const { return m_nearest[candidate][0] >= m_distance; }
    void close(std::size_t candidate) { m_nearest[candidate][0] = 0; }

    bool has_room(const Vector3& point) const {
        bool has = true;
        m_chosen_by_place.near(point, [&](std::size_t i) { has = has && length(minus(m_chosen[i], point)) >= m_distance; });
        return has;
    }

    void choose(const Vector3& point) {
        m_chosen_by_place.add(point, m_chosen.size());
        m_chosen.push_back(point);
        m_by_place.near(point, [&](std::size_t i) {
            std::array<double, 2>& nearest = m_nearest[i];
            const double here = length(minus(m_candidates[i], point));
            if (here >= nearest[1] || !has_room(i)) {
                return;
            }
            nearest = here < nearest[0] ? std::array{here, nearest[0]} : std::array{nearest[0], here};
            if (has_room(i)) {
                m_queue.push({-(nearest[0] + nearest[1]), i});
            }
        });
    }

    /** That with room which is nearest to two that are chosen. */
    std::optional<std::size_t> next() {
        while (!m_queue.empty()) {
            const auto [nearness, candidate] = m_queue.top();
            m_queue.pop();
            if (has_room(candidate) && -nearness == m_nearest[candidate][0] + m_nearest[candidate][1]) {
                return candidate;
            }
        }
        return std::nullopt;
    }

private:
    const std::vector<Vector3>& m_candidates;
    double m_distance;
    Cells m_by_place, m_chosen_by_place;
    std::vector<Vector3> m_chosen;
    /** Distances to the two nearest that are chosen, at most twice the distance; 0 where there is no room. */
    std::vector<std::array<double, 2>> m_nearest;
    std::priority_queue<std::pair<double, std::size_t>> m_queue;
};

} // namespace

std::vector<std::size_t> choose_evenly(const std::vector<Vector3>& candidates, double distance,
                                       const std::function<std::optional<Vector3>(std::size_t candidate)>& place) {
    std::vector<std::size_t> chosen;
    Front front(candidates, distance);
    const auto try_one = [&](std::size_t candidate) {
        front.close(candidate);
        const std::optional<Vector3> point = place(candidate);
        if (point && front.has_room(*point)) {
            front.choose(*point);
            chosen.push_back(candidate);
        }
    };
    for (std::size_t first = 0; first < candidates.size(); ++first) {
        if (front.has_room(first)) {
            try_one(first);
        }
        while (const std::optional<std::size_t> next = front.next()) {
            try_one(*next);
        }
    }
    return chosen;
}

} // namespace elvis
