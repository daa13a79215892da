/**
 * @file lines.hpp
 * Exact tests of what lines on a horizontal cut plane meet a pixel's square.
 */
#pragma once

#include <core/oracle/picture/ray.hpp>

#include <core/render/frame.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace elvis::oracle {

using Point = std::array<long double, 2>;
using Square = std::array<Point, 4>;

/** Height of the plane. */
inline constexpr double plane_z = 0.53;

// x and y of where the corners of a pixel lie on the plane, in turn.
inline Square square_of(const FrameRequest& request, std::uint32_t column, std::uint32_t row) {
    Square square;
    for (std::size_t corner = 0; corner < 4; ++corner) {
        const long double across = column + (corner == 0 || corner == 3 ? -0.5L : 0.5L);
        const long double down = row + (corner < 2 ? -0.5L : 0.5L);
        const Ray ray = pixel_ray(request.camera, request.width, request.height, across, down);
        const long double t = (plane_z - ray.origin.z()) / ray.direction.z();
        square[corner] = {ray.origin.x() + t * ray.direction.x(), ray.origin.y() + t * ray.direction.y()};
    }
    return square;
}

// Squares of the smallest and largest distance of the quadrilateral from a point.
inline std::array<long double, 2> distances(const Square& square, const Point& centre) {
    long double least = std::numeric_limits<long double>::infinity(), most = 0;
    bool is_left = true, is_right = true;
    for (std::size_t i = 0; i < 4; ++i) {
        const Point a = {square[i][0] - centre[0], square[i][1] - centre[1]};
        const Point b = {square[(i + 1) % 4][0] - centre[0], square[(i + 1) % 4][1] - centre[1]};
        const Point side = {b[0] - a[0], b[1] - a[1]};
        const long double t =
            std::clamp(-(a[0] * side[0] + a[1] * side[1]) / (side[0] * side[0] + side[1] * side[1]), 0.0L, 1.0L);
        const Point nearest = {a[0] + t * side[0], a[1] + t * side[1]};
        least = std::min(least, nearest[0] * nearest[0] + nearest[1] * nearest[1]);
        most = std::max(most, a[0] * a[0] + a[1] * a[1]);
        const long double turn = a[0] * b[1] - a[1] * b[0];
        is_left = is_left && turn >= 0;
        is_right = is_right && turn <= 0;
    }
    return {is_left || is_right ? 0 : least, most};
}

struct Verdict {
    std::size_t marked = 0, undecided = 0;
    std::size_t wrong = 0;
};

// `meets`: whether a square meets the line, exactly; the flags say yes and undecided.
template <class Meets>
Verdict judge(const FrameRequest& request, const Frame& frame, std::uint32_t yes, std::uint32_t open, Meets meets) {
    Verdict verdict;
    for (std::uint32_t row = 0; row < frame.height; ++row) {
        for (std::uint32_t column = 0; column < frame.width; ++column) {
            const std::uint32_t flags = frame.flags[std::size_t{row} * frame.width + column];
            const bool is_marked = (flags & yes) != 0;
            const bool is_undecided = (flags & open) != 0;
            verdict.marked += is_marked ? 1 : 0;
            verdict.undecided += is_undecided ? 1 : 0;
            verdict.wrong += !is_undecided && is_marked != meets(square_of(request, column, row)) ? 1 : 0;
        }
    }
    return verdict;
}

// The plane z = plane_z seen askew, around a point of it.
inline FrameRequest view_around(const Point& middle, double magnification, std::uint32_t size) {
    FrameRequest request;
    request.width = request.height = size;
    const double x = static_cast<double>(middle[0]), y = static_cast<double>(middle[1]);
    request.camera.look_at = {x, y, plane_z};
    request.camera.eye = {x + 0.4 / magnification, y - 0.5 / magnification, plane_z + 1.7 / magnification};
    request.camera.up = {0.2, 1, 0.1};
    request.camera.field_of_view = 30;
    Surface surface;
    surface.geometry = CutPlane{{0, 0, 1, -plane_z}};
    surface.colors.points = {{0, {0, 0, 0}}, {2, {1, 1, 1}}};
    request.surfaces = {surface};
    return request;
}

} // namespace elvis::oracle
