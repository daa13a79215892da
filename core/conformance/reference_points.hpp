/**
 * @file reference_points.hpp
 * Points of reference shapes and elements of volumes to check with.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis::conformance {

using Point = Vector3;

/** Points of the closed shape: its corners first, then points in its interior and on its faces, as the seed says. */
std::vector<Point> points_in(elvis_shape shape, std::size_t count, std::uint64_t seed);
/** Points of the interior, not near the boundary, so that differences find room. */
std::vector<Point> interior_points(elvis_shape shape, std::size_t count, std::uint64_t seed);

std::string shape_name(elvis_shape shape);

std::vector<double> flat(const std::vector<Point>& points);

/** Class of an element. */
std::uint32_t class_of(const RuntimeVolume& volume, std::uint64_t element);

/** Up to `count` elements of every class: the first, the last, and others as the seed says. */
std::vector<std::uint64_t> some_elements(const RuntimeVolume& volume, std::size_t count, std::uint64_t seed);

} // namespace elvis::conformance
