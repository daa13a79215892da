#include <core/base/error.hpp>
#include <core/base/infinity.hpp>
#include <core/base/vector3.hpp>
#include <core/convert/blocks.hpp>
#include <core/convert/topology/corners.hpp>
#include <core/convert/topology/grid_cell.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <unordered_map>

namespace elvis {

namespace {

constexpr std::uint64_t part_size = 4096;
constexpr std::uint64_t corner_block_size = 65536;

/** Distinct positions, found through a grid of cells much larger than the tolerance. */
class PositionNumbers {
public:
    explicit PositionNumbers(double tolerance) : m_tolerance(tolerance), m_cell(16 * tolerance) {}

    std::uint32_t number(const Vector3& x) {
        const GridCell low = cell_of(minus(x, {m_tolerance, m_tolerance, m_tolerance}), m_cell);
        const GridCell high = cell_of(plus(x, {m_tolerance, m_tolerance, m_tolerance}), m_cell);
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
            for (std::int64_t j = low[1]; j <= high[1]; ++j) {
                for (std::int64_t k = low[2]; k <= high[2]; ++k) {
                    const auto [first, last] = m_cells.equal_range(hash_of({i, j, k}));
                    for (auto candidate = first; candidate != last; ++candidate) {
                        if (is_near(m_positions[candidate->second], x)) {
                            return candidate->second;
                        }
                    }
                }
            }
        }
        const auto number = static_cast<std::uint32_t>(m_positions.size());
        m_cells.emplace(hash_of(cell_of(x, m_cell)), number);
        m_positions.push_back(x);
        return number;
    }

private:
    bool is_near(const Vector3& a, const Vector3& b) const {
        const Vector3 between = minus(a, b);
        return dot(between, between) <= m_tolerance * m_tolerance;
    }

    double m_tolerance;
    double m_cell;
    std::vector<Vector3> m_positions;
    std::unordered_multimap<std::uint64_t, std::uint32_t> m_cells;
};

std::vector<double> corner_points(elvis_shape shape) {
    std::vector<double> xi;
    for (int corner = 0; corner < native::n_corners(static_cast<native::Shape>(shape)); ++corner) {
        const native::Point point = native::corner(static_cast<native::Shape>(shape), corner);
        xi.insert(xi.end(), point.begin(), point.end());
    }
    return xi;
}

double shortest_distance(const std::vector<Vector3>& corners) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < corners.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            shortest = std::min(shortest, std::hypot(corners[a][0] - corners[b][0], corners[a][1] - corners[b][1],
                                                     corners[a][2] - corners[b][2]));
        }
    }
    return shortest;
}

/** Positions of the corners of elements. */
class CornerPositions {
public:
    CornerPositions(const SourceVolume& source, const std::vector<elvis_shape>& shapes) : m_source(source), m_shapes(shapes) {
        for (elvis_shape shape = 0; shape < m_xi.size(); ++shape) {
            m_xi[shape] = corner_points(shape);
        }
    }

    std::size_t n_corners(std::uint64_t element) const { return m_xi[m_shapes[element]].size() / 3; }

    void evaluate(std::uint64_t element, std::vector<Vector3>& positions) const {
        const std::vector<double>& points = m_xi[m_shapes[element]];
        positions.resize(points.size() / 3);
        m_source.evaluate_mapping(element, points, std::span<double>(positions.front().data(), points.size()));
    }

private:
    const SourceVolume& m_source;
    const std::vector<elvis_shape>& m_shapes;
    std::array<std::vector<double>, 6> m_xi;
};

void measure_extent(Corners& corners, const CornerPositions& positions, const SourceVolume& source,
                    const TaskControl& control) {
    Vector3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    double shortest = infinity;
    std::mutex mutex;
    for_each_part(source.info().n_elements, part_size, [&](std::uint64_t first, std::uint64_t last) {
        control.check();
        std::vector<Vector3> of_element;
        Vector3 part_lower{infinity, infinity, infinity}, part_upper{-infinity, -infinity, -infinity};
        double part_shortest = infinity;
        for (std::uint64_t element = first; element < last; ++element) {
            positions.evaluate(element, of_element);
            part_shortest = std::min(part_shortest, shortest_distance(of_element));
            for (const Vector3& x : of_element) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    part_lower[axis] = std::min(part_lower[axis], x[axis]);
                    part_upper[axis] = std::max(part_upper[axis], x[axis]);
                }
            }
        }
        const std::lock_guard lock(mutex);
        shortest = std::min(shortest, part_shortest);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], part_lower[axis]);
            upper[axis] = std::max(upper[axis], part_upper[axis]);
        }
    });
    for (std::size_t axis = 0; axis < 3; ++axis) {
        corners.extent = std::max(corners.extent, upper[axis] - lower[axis]);
        corners.largest_coordinate = std::max({corners.largest_coordinate, std::abs(lower[axis]), std::abs(upper[axis])});
    }
    corners.tolerance = source.info().corner_tolerance;
    if (!(corners.tolerance > 0)) {
        corners.tolerance = shortest > 0 ? std::min(1e-7 * corners.extent, 1e-3 * shortest) : 1e-9 * corners.extent;
        corners.tolerance = std::max(corners.tolerance, std::numeric_limits<double>::min());
    }
}

void take_ids(Corners& corners, const CornerPositions& positions, const SourceVolume& source) {
    if (source.info().n_corner_ids >= no_corner) {
        throw Error(source.paths().front(), "has more than 4294967294 corner ids");
    }
    const std::uint64_t n_elements = source.info().n_elements;
    std::vector<elvis_source_element> elements;
    for (std::uint64_t first = 0; first < n_elements; first += corner_block_size) {
        elements.resize(std::min(corner_block_size, n_elements - first));
        source.elements(first, elements.size(), elements);
        for (std::uint64_t index = 0; index < elements.size(); ++index) {
            for (std::size_t corner = 0; corner < positions.n_corners(first + index); ++corner) {
                corners.of_element[first + index][corner] = static_cast<std::uint32_t>(elements[index].corners[corner]);
            }
        }
    }
}

/** Positions are evaluated by all processors and numbered by one, in the order of elements. */
void number_positions(Corners& corners, const CornerPositions& positions, const SourceVolume& source,
                      const TaskControl& control) {
    const std::uint64_t n_elements = source.info().n_elements;
    PositionNumbers numbers(corners.tolerance);
    std::vector<std::vector<Vector3>> block(std::min(corner_block_size, n_elements));
    for (std::uint64_t first = 0; first < n_elements; first += corner_block_size) {
        control.check();
        const std::uint64_t count = std::min(corner_block_size, n_elements - first);
        for_each_part(count, part_size, [&](std::uint64_t part_first, std::uint64_t part_last) {
            for (std::uint64_t index = part_first; index < part_last; ++index) {
                positions.evaluate(first + index, block[index]);
            }
        });
        for (std::uint64_t index = 0; index < count; ++index) {
            for (std::size_t corner = 0; corner < block[index].size(); ++corner) {
                corners.of_element[first + index][corner] = numbers.number(block[index][corner]);
            }
        }
    }
}

} // namespace

Corners number_corners(const SourceVolume& source, const std::vector<elvis_shape>& shapes, const TaskControl& control) {
    const CornerPositions positions(source, shapes);
    Corners corners;
    measure_extent(corners, positions, source, control);
    CornerNumbers none;
    none.fill(no_corner);
    corners.of_element.assign(shapes.size(), none);
    if (source.info().n_corner_ids > 0) {
        take_ids(corners, positions, source);
    } else {
        number_positions(corners, positions, source, control);
    }
    return corners;
}

} // namespace elvis
