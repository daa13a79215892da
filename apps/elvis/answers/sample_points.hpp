/**
 * @file sample_points.hpp
 * Where `elvis sample` asks: along lines, at points of a file, on grids.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::commands {

struct SamplePoints {
    /** Three numbers a point. */
    std::vector<double> positions;
    /** Of lines and polylines: from the first point. Else empty. */
    std::vector<double> arc_lengths;

    /** Of lines and polylines. */
    std::vector<std::array<double, 3>> corners;

    /** Points along x, y and z, the first fastest. Not of lines and lists. */
    std::optional<std::array<std::size_t, 3>> grid;
    /** Of grids along the axes. */
    std::array<double, 3> origin{}, spacing{};
    bool is_axis_parallel = false;

    std::size_t size() const { return positions.size() / 3; }
};

/** `count` points, evenly along the way through the corners, ends included. At least two corners and two points. */
SamplePoints points_along(std::vector<std::array<double, 3>> corners, std::size_t count);
/** Three numbers a line; # begins a comment. */
std::vector<std::array<double, 3>> read_points(const std::string& path);
/** Over a box: min x y z, max x y z. */
SamplePoints grid_in(const std::array<double, 6>& box, const std::array<std::size_t, 3>& n);
/** On the plane ax+by+cz+d=0, over the part of it that the box has. */
SamplePoints grid_on_plane(const std::array<double, 4>& plane, const std::array<double, 6>& box, std::size_t n_columns,
                           std::size_t n_rows);
/** "64x64x32": as many numbers as are expected, each at least 1. */
std::vector<std::size_t> grid_size(const char* option, const std::string& text, std::size_t n_numbers);

} // namespace elvis::commands
