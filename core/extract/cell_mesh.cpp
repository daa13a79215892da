#include <core/extract/cell_mesh.hpp>

#include <core/base/error.hpp>
#include <core/base/in_parts.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace elvis {

namespace {

/** Of the tolerance, and of an element's shortest edge: what positions of the same point may differ by. */
constexpr double weld_share = 1e-3, weld_edge_share = 1e-5;
/** Of the largest level: what a continuous field's values may differ by from element to element. */
constexpr double continuous_share = 1e-9;

double shortest_edge(const ElementCells& cells) {
    double shortest = HUGE_VAL;
    for (std::size_t i = 0; i < cells.points().size(); ++i) {
        for (std::size_t j = i + 1; j < cells.points().size(); ++j) {
            const double distance = length(minus(cells.points()[i].position, cells.points()[j].position));
            shortest = distance > 0 ? std::min(shortest, distance) : shortest;
        }
    }
    return shortest;
}

} // namespace

CellMesh::CellMesh(const SurfaceSampler& sampler, const CellJudge& judge, std::vector<MeshElement> elements, double tolerance,
                   std::uint64_t most_cells, const TaskControl& control)
    : m_sampler(sampler), m_judge(judge), m_control(control), m_elements(std::move(elements)), m_distances(m_elements.size()),
      m_is_sampled(m_elements.size()), m_tolerance(tolerance), m_most_cells(most_cells), m_weld(weld_share * tolerance),
      m_background(std::max(1u, std::thread::hardware_concurrency())) {
    for (const MeshElement& element : m_elements) {
        m_cells.emplace_back(element.element, element.shape, element.faces);
    }
    for_each_element("dividing elements", [&](std::size_t index) { m_cells[index].place_corners(m_sampler); });
    for (std::size_t index = 0; index < m_cells.size(); ++index) {
        m_distances[index] = std::min(weld_share * m_tolerance, weld_edge_share * shortest_edge(m_cells[index]));
        for (const CellPoint& point : m_cells[index].points()) {
            const double level = std::abs(point.level.value);
            m_level_rounding = std::max(m_level_rounding, std::isfinite(level) ? continuous_share * level : 0);
        }
    }
    for (std::size_t index = 0; index < m_cells.size(); ++index) {
        for (CellPoint& point : m_cells[index].points()) {
            weld(point, m_distances[index]);
        }
        m_cells[index].make_cells();
    }
}

void CellMesh::for_each_element(const char* activity, const std::function<void(std::size_t)>& work) {
    constexpr std::uint64_t parts_a_thread = 64;
    const std::uint64_t n = m_cells.size();
    const std::uint64_t part = m_sampler.is_one_at_a_time()
                                   ? std::max<std::uint64_t>(1, n)
                                   : std::max<std::uint64_t>(1, n / (parts_a_thread * std::thread::hardware_concurrency() + 1));
    std::atomic<std::uint64_t> n_done = 0;
    in_parts(
        m_background, n, part,
        [&](std::uint64_t first, std::uint64_t count) {
            for (std::uint64_t index = first; index < first + count; ++index) {
                m_control.check();
                work(index);
            }
            n_done += count;
        },
        [&] {
            m_control.check();
            m_control.progress(static_cast<double>(n_done.load()) / static_cast<double>(std::max<std::uint64_t>(1, n)),
                               activity);
        });
}

void CellMesh::weld(CellPoint& point, double distance) {
    if (point.id != CellPoint::no_id) {
        return;
    }
    point.id = m_weld.find_or_add(point.position, distance, point.level.value);
    // Both sides of a face have to agree on which side of the surface a point is.
    const double shared = m_weld.level(point.id);
    if (std::abs(shared - point.level.value) <= m_level_rounding) {
        point.level.value = shared;
    }
}

std::uint64_t CellMesh::n_cells() const {
    std::uint64_t n = 0;
    for (const ElementCells& cells : m_cells) {
        n += cells.cells().size();
    }
    return n;
}

std::uint64_t CellMesh::n_sampled_elements() const {
    return static_cast<std::uint64_t>(std::ranges::count(m_is_sampled, std::uint8_t{1}));
}

bool CellMesh::is_longer(std::uint64_t edge, std::uint64_t other) const {
    const auto squared = [&](std::uint64_t key) {
        const Vector3 way = minus(m_weld.position(static_cast<std::uint32_t>(key >> 32)),
                                  m_weld.position(static_cast<std::uint32_t>(key & 0xffffffffu)));
        return dot(way, way);
    };
    const double mine = squared(edge), theirs = squared(other);
    return mine != theirs ? mine > theirs : edge > other;
}

bool CellMesh::has_wanted() const {
    return std::ranges::any_of(m_cells, [](const ElementCells& cells) {
        return std::ranges::any_of(cells.cells(), [](const Cell& cell) { return cell.state == Cell::State::wanted; });
    });
}

void CellMesh::judge_fresh() {
    for_each_element("looking for the surface", [&](std::size_t index) {
        const MeshElement& element = m_elements[index];
        const bool is_sampled = m_judge.judge(m_cells[index], element.bend, element.least_depth, element.outer_faces);
        m_is_sampled[index] = is_sampled ? 1 : m_is_sampled[index];
        m_cells[index].sweep();
    });
}

void CellMesh::mark_neighbours(const std::unordered_set<std::uint64_t>& halved) {
    std::vector<std::uint8_t> is_end(m_weld.size());
    for (const std::uint64_t edge : halved) {
        is_end[edge >> 32] = 1;
        is_end[edge & 0xffffffffu] = 1;
    }
    for_each_element("dividing", [&](std::size_t index) {
        ElementCells& cells = m_cells[index];
        for (Cell& cell : cells.cells()) {
            for (std::size_t edge = 0; edge < cell.n_edges() && cell.state != Cell::State::wanted; ++edge) {
                const auto [a, b] = cell.edge(edge);
                const std::uint32_t from = cells.points()[a].id, to = cells.points()[b].id;
                const bool is_fresh = cell.state == Cell::State::fresh;
                const std::uint64_t key = pair_key(from, to);
                if (is_fresh ? m_halved.contains(key) : is_end[from] != 0 && is_end[to] != 0 && halved.contains(key)) {
                    cell.state = Cell::State::wanted;
                }
            }
        }
    });
}

void CellMesh::halve_wanted() {
    while (has_wanted()) {
        std::vector<ElementCells::Halved> found(m_cells.size());
        for_each_element("dividing", [&](std::size_t index) {
            found[index] = m_cells[index].halve_wanted(
                m_sampler, [&](std::uint64_t edge, std::uint64_t other) { return is_longer(edge, other); });
            m_cells[index].sweep();
        });
        if (n_cells() > m_most_cells) {
            throw Error(m_sampler.volume().path(),
                        "would take more than " + std::to_string(m_most_cells) + " cells; a larger tolerance takes fewer");
        }
        std::unordered_set<std::uint64_t> halved;
        for (std::size_t index = 0; index < m_cells.size(); ++index) {
            for (const std::uint32_t point : found[index].points) {
                weld(m_cells[index].points()[point], m_distances[index]);
            }
            halved.insert(found[index].edges.begin(), found[index].edges.end());
        }
        m_halved.insert(halved.begin(), halved.end());
        mark_neighbours(halved);
    }
}

void CellMesh::refine() {
    do {
        halve_wanted();
        judge_fresh();
    } while (has_wanted());
}

} // namespace elvis
