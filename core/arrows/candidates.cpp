#include <core/arrows/candidates.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace elvis {

void need_few(double n_points) {
    constexpr double most_points = 1e6;
    if (!(n_points <= most_points)) {
        throw Error("arrows", "the spacing is too small: there would be about " + std::to_string(n_points) +
                                  " places to look at, and 1000000 are the most");
    }
}

std::vector<std::vector<double>> lattice_of_face(std::size_t n_corners, int n) {
    std::vector<std::vector<double>> weights;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= (n_corners == 3 ? n - j : n); ++i) {
            const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
            weights.push_back(n_corners == 3 ? std::vector{1 - u - v, u, v}
                                             : std::vector{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v});
        }
    }
    return weights;
}

Vector3 weighted(const std::vector<Vector3>& corners, const std::vector<double>& weights) {
    Vector3 sum{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        sum = plus(sum, scaled(corners[i], weights[i]));
    }
    return sum;
}

std::array<Vector3, 2> across(const Vector3& normal) {
    std::size_t least = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
        least = std::abs(normal[axis]) < std::abs(normal[least]) ? axis : least;
    }
    Vector3 other{};
    other[least] = 1;
    const Vector3 first = unit(cross(normal, other));
    return {first, cross(normal, first)};
}

bool Candidates::add(const Vector3& point) {
    std::array<std::int64_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        cell[axis] = static_cast<std::int64_t>(std::floor(2 * point[axis] / m_step));
    }
    if (!m_cells.insert(cell).second) {
        return false;
    }
    m_points.push_back(point);
    need_few(static_cast<double>(m_points.size()));
    return true;
}

void Candidates::add_triangle(const std::vector<Vector3>& corners) {
    const double longest = std::max(
        {length(minus(corners[1], corners[0])), length(minus(corners[2], corners[1])), length(minus(corners[0], corners[2]))});
    const double n = std::max(1.0, std::ceil(longest / m_step));
    need_few(0.5 * n * n);
    for (const std::vector<double>& weights : lattice_of_face(3, static_cast<int>(n))) {
        add(weighted(corners, weights));
    }
}

void Candidates::add_rings(const Vector3& origin, const Vector3& axis, const std::vector<std::array<double, 2>>& curve) {
    const auto [first, second] = across(axis);
    for (const auto& [radius, height] : curve) {
        const Vector3 middle = plus(origin, scaled(axis, height));
        const double n = std::max(1.0, std::ceil(2 * std::numbers::pi * radius / m_step));
        need_few(n);
        for (double i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n;
            const Vector3 way = plus(scaled(first, std::cos(angle)), scaled(second, std::sin(angle)));
            add(plus(middle, scaled(way, radius)));
        }
    }
}

} // namespace elvis
