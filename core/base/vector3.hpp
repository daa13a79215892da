/**
 * @file vector3.hpp
 * Three numbers as vectors.
 */
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

using Vector3 = std::array<double, 3>;

inline Vector3 plus(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector3 minus(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector3 scaled(const Vector3& a, double factor) { return {factor * a[0], factor * a[1], factor * a[2]}; }
inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector3& a) { return std::sqrt(dot(a, a)); }

/** The largest component, without its sign. */
inline double largest(const Vector3& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }

/** One row of a matrix times a column. */
inline double dot(const double* row, const Vector3& a) { return row[0] * a[0] + row[1] * a[1] + row[2] * a[2]; }
/** A matrix, row by row, times a column. */
inline Vector3 product(const std::array<double, 9>& matrix, const Vector3& a) {
    return {dot(&matrix[0], a), dot(&matrix[3], a), dot(&matrix[6], a)};
}

/** Of length 1; a is not zero. */
inline Vector3 unit(const Vector3& a) {
    const double size = length(a);
    return {a[0] / size, a[1] / size, a[2] / size};
}

} // namespace elvis
