/**
 * @file vector3.hpp
 * Three numbers as vectors.
 */
#pragma once

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

/** Of length 1; a is not zero. */
inline Vector3 unit(const Vector3& a) {
    const double size = length(a);
    return {a[0] / size, a[1] / size, a[2] / size};
}

} // namespace elvis
