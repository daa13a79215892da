#include <core/convert/blocks.hpp>
#include <core/convert/corners.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace elvis {

namespace {

constexpr std::uint64_t part_size = 4096;
using Position = std::array<double, 3>;

/** Distinct positions, found through a grid of cells much larger than the tolerance. */
class PositionNumbers {
public:
    explicit PositionNumbers(double tolerance) : m_tolerance(tolerance), m_cell(16 * tolerance) {}

    std::int64_t number(const Position& x) {
        std::array<std::int64_t, 3> low{}, high{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = static_cast<std::int64_t>(std::floor((x[axis] - m_tolerance) / m_cell));
            high[axis] = static_cast<std::int64_t>(std::floor((x[axis] + m_tolerance) / m_cell));
        }
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
            for (std::int64_t j = low[1]; j <= high[1]; ++j) {
                for (std::int64_t k = low[2]; k <= high[2]; ++k) {
                    const auto [first, last] = m_cells.equal_range(hash({i, j, k}));
                    for (auto candidate = first; candidate != last; ++candidate) {
                        if (is_near(m_positions[static_cast<std::size_t>(candidate->second)], x)) {
                            return candidate->second;
                        }
                    }
                }
            }
        }
        const auto number = static_cast<std::int64_t>(m_positions.size());
        std::array<std::int64_t, 3> cell{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cell[axis] = static_cast<std::int64_t>(std::floor(x[axis] / m_cell));
        }
        m_cells.emplace(hash(cell), number);
        m_positions.push_back(x);
        return number;
    }

private:
    static std::uint64_t hash(const std::array<std::int64_t, 3>& cell) {
        std::uint64_t value = 0;
        for (const std::int64_t index : cell) {
            value = (value ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
            value ^= value >> 29;
        }
        return value;
    }

    bool is_near(const Position& a, const Position& b) const {
        const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
        return x * x + y * y + z * z <= m_tolerance * m_tolerance;
    }

    double m_tolerance;
    double m_cell;
    std::vector<Position> m_positions;
    std::unordered_multimap<std::uint64_t, std::int64_t> m_cells;
};

std::vector<double> corner_points(elvis_shape shape) {
    std::vector<double> xi;
    for (int corner = 0; corner < native::n_corners(static_cast<native::Shape>(shape)); ++corner) {
        const native::Point point = native::corner(static_cast<native::Shape>(shape), corner);
        xi.insert(xi.end(), point.begin(), point.end());
    }
    return xi;
}

double shortest_distance(const std::vector<Position>& corners) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < corners.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            shortest = std::min(shortest, std::hypot(corners[a][0] - corners[b][0], corners[a][1] - corners[b][1],
                                                     corners[a][2] - corners[b][2]));
        }
    }
    return shortest;
}

} // namespace

Corners number_corners(const SourceVolume& source, const std::vector<elvis_shape>& shapes, const TaskControl& control) {
    const std::uint64_t n_elements = shapes.size();
    std::array<std::vector<double>, 6> xi;
    for (elvis_shape shape = 0; shape < xi.size(); ++shape) {
        xi[shape] = corner_points(shape);
    }
    std::vector<std::vector<Position>> positions(n_elements);
    control.progress(-1, "finding corners");
    for_each_part(n_elements, part_size, [&](unsigned, std::uint64_t first, std::uint64_t last) {
        control.check();
        for (std::uint64_t element = first; element < last; ++element) {
            const std::vector<double>& points = xi[shapes[element]];
            positions[element].resize(points.size() / 3);
            source.evaluate_mapping(element, points, std::span<double>(positions[element].front().data(), points.size()));
        }
    });

    Position lower{}, upper{};
    lower.fill(std::numeric_limits<double>::infinity());
    upper.fill(-std::numeric_limits<double>::infinity());
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::vector<Position>& corners : positions) {
        shortest = std::min(shortest, shortest_distance(corners));
        for (const Position& x : corners) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                lower[axis] = std::min(lower[axis], x[axis]);
                upper[axis] = std::max(upper[axis], x[axis]);
            }
        }
    }
    Corners corners;
    corners.extent = std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
    corners.tolerance = source.info().corner_tolerance;
    if (!(corners.tolerance > 0)) {
        corners.tolerance = shortest > 0 ? std::min(1e-7 * corners.extent, 1e-3 * shortest) : 1e-9 * corners.extent;
        corners.tolerance = std::max(corners.tolerance, std::numeric_limits<double>::min());
    }

    std::array<std::int64_t, 8> none{};
    none.fill(-1);
    corners.of_element.assign(n_elements, none);
    if (source.info().n_corner_ids > 0) {
        std::vector<elvis_source_element> elements;
        for (std::uint64_t first = 0; first < n_elements; first += part_size) {
            elements.resize(std::min(part_size, n_elements - first));
            source.elements(first, elements.size(), elements);
            for (std::uint64_t index = 0; index < elements.size(); ++index) {
                std::copy_n(elements[index].corners, positions[first + index].size(),
                            corners.of_element[first + index].begin());
            }
        }
        return corners;
    }
    PositionNumbers numbers(corners.tolerance);
    for (std::uint64_t element = 0; element < n_elements; ++element) {
        for (std::size_t corner = 0; corner < positions[element].size(); ++corner) {
            corners.of_element[element][corner] = numbers.number(positions[element][corner]);
        }
    }
    return corners;
}

} // namespace elvis
