#include "sample_points.hpp"

#include <core/base/error.hpp>
#include <core/base/vector3.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace elvis::commands {

namespace {

void append(std::vector<double>& list, const Vector3& point) { list.insert(list.end(), point.begin(), point.end()); }

/** The share of the way from 0 to n - 1; half the way if there is one point. */
double share(std::size_t index, std::size_t n) { return n > 1 ? static_cast<double>(index) / static_cast<double>(n - 1) : 0.5; }

/** Two directions of length 1 in the plane, as near to the axes as can be. */
std::array<Vector3, 2> directions_in(const Vector3& normal) {
    std::size_t smallest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
        smallest = std::abs(normal[axis]) < std::abs(normal[smallest]) ? axis : smallest;
    }
    Vector3 along{};
    along[smallest] = 1;
    const Vector3 first = unit(minus(along, scaled(normal, dot(along, normal))));
    return {first, cross(normal, first)};
}

} // namespace

SamplePoints points_along(std::vector<Vector3> corners, std::size_t count) {
    std::vector<double> lengths{0};
    for (std::size_t i = 1; i < corners.size(); ++i) {
        lengths.push_back(lengths.back() + length(minus(corners[i], corners[i - 1])));
    }
    SamplePoints points;
    std::size_t piece = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double arc_length = share(i, count) * lengths.back();
        while (piece + 1 < corners.size() && lengths[piece] < arc_length) {
            ++piece;
        }
        const double size = lengths[piece] - lengths[piece - 1];
        const double along = size > 0 ? std::min(1.0, (arc_length - lengths[piece - 1]) / size) : 0;
        append(points.positions, plus(scaled(corners[piece - 1], 1 - along), scaled(corners[piece], along)));
        points.arc_lengths.push_back(arc_length);
    }
    points.corners = std::move(corners);
    return points;
}

std::vector<Vector3> read_points(const std::string& path) {
    std::ifstream file(path);
    if (!file) {
        throw Error(path, "cannot be opened");
    }
    std::vector<Vector3> points;
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        line.resize(std::min(line.size(), line.find('#')));
        std::ranges::replace(line, ',', ' ');
        std::istringstream words(line);
        Vector3 point{};
        std::string rest;
        if (!(words >> rest)) {
            continue;
        }
        words.clear();
        words.seekg(0);
        if (!(words >> point[0] >> point[1] >> point[2]) || words >> rest) {
            throw Error(path + ":" + std::to_string(number), "expected three numbers, found '" + line + "'");
        }
        points.push_back(point);
    }
    if (file.bad()) {
        throw Error(path, "cannot be read");
    }
    if (points.empty()) {
        throw Error(path, "has no points");
    }
    return points;
}

SamplePoints grid_in(const std::array<double, 6>& box, const std::array<std::size_t, 3>& n) {
    SamplePoints points;
    points.grid = n;
    points.is_axis_parallel = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double size = box[3 + axis] - box[axis];
        points.origin[axis] = n[axis] > 1 ? box[axis] : box[axis] + 0.5 * size;
        // Of one layer it means nothing, but it must not be zero.
        points.spacing[axis] = n[axis] > 1 ? size / static_cast<double>(n[axis] - 1) : size > 0 ? size : 1;
    }
    points.positions.reserve(3 * n[0] * n[1] * n[2]);
    for (std::size_t k = 0; k < n[2]; ++k) {
        for (std::size_t j = 0; j < n[1]; ++j) {
            for (std::size_t i = 0; i < n[0]; ++i) {
                const std::array<std::size_t, 3> at{i, j, k};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    points.positions.push_back(
                        std::min(box[3 + axis], points.origin[axis] + static_cast<double>(at[axis]) * points.spacing[axis]));
                }
            }
        }
    }
    return points;
}

SamplePoints grid_on_plane(const std::array<double, 4>& plane, const std::array<double, 6>& box, std::size_t n_columns,
                           std::size_t n_rows) {
    const Vector3 normal{plane[0], plane[1], plane[2]};
    const double size = length(normal);
    const Vector3 foot = scaled(normal, -plane[3] / (size * size));
    const auto [right, up] = directions_in(scaled(normal, 1 / size));
    // Of the points in which edges of the box meet the plane.
    double left = HUGE_VAL, below = HUGE_VAL, most_right = -HUGE_VAL, above = -HUGE_VAL;
    const auto corner = [&](unsigned index) {
        return Vector3{box[(index & 1u) != 0 ? 3 : 0], box[(index & 2u) != 0 ? 4 : 1], box[(index & 4u) != 0 ? 5 : 2]};
    };
    for (unsigned index = 0; index < 8; ++index) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            const Vector3 a = corner(index), b = corner(index | (1u << axis));
            const double at_a = dot(normal, a) + plane[3], at_b = dot(normal, b) + plane[3];
            if ((index & (1u << axis)) != 0 || (at_a > 0) == (at_b > 0)) {
                continue;
            }
            const Vector3 place = minus(plus(a, scaled(minus(b, a), at_a / (at_a - at_b))), foot);
            left = std::min(left, dot(place, right));
            most_right = std::max(most_right, dot(place, right));
            below = std::min(below, dot(place, up));
            above = std::max(above, dot(place, up));
        }
    }
    if (!(left <= most_right)) {
        throw UsageError("--cut-plane", "the plane does not meet the box of the volume");
    }
    SamplePoints points;
    points.grid = {n_columns, n_rows, 1};
    for (std::size_t j = 0; j < n_rows; ++j) {
        for (std::size_t i = 0; i < n_columns; ++i) {
            const double x = left + share(i, n_columns) * (most_right - left), y = below + share(j, n_rows) * (above - below);
            append(points.positions, plus(foot, plus(scaled(right, x), scaled(up, y))));
        }
    }
    return points;
}

std::vector<std::size_t> grid_size(const char* option, const std::string& text, std::size_t n_numbers) {
    constexpr std::size_t most_points = 1'000'000'000;
    std::vector<std::size_t> sizes;
    std::size_t product = 1;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, 'x');) {
        std::size_t size = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), size);
        if (error != std::errc{} || end != word.data() + word.size() || size == 0 || size > most_points / product) {
            throw UsageError(option, "'" + text + "' is no size such as " + (n_numbers == 3 ? "64x64x32" : "640x480") +
                                         " of at most a billion points");
        }
        product *= size;
        sizes.push_back(size);
    }
    if (sizes.size() != n_numbers) {
        throw UsageError(option, "'" + text + "' has " + std::to_string(sizes.size()) + " numbers where " +
                                     std::to_string(n_numbers) + " are expected");
    }
    return sizes;
}

} // namespace elvis::commands
