/**
 * @file vectors.hpp
 * Three numbers as vectors.
 */
#pragma once

#include <array>
#include <cmath>

namespace elvis::view {

using Vector = std::array<double, 3>;

inline Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector scaled(const Vector& a, double factor) { return {factor * a[0], factor * a[1], factor * a[2]}; }
inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }
inline Vector unit(const Vector& a) { return scaled(a, 1 / length(a)); }
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/** Turned by an angle in radians about a unit axis (Rodrigues). */
inline Vector turned(const Vector& a, const Vector& axis, double angle) {
    const double c = std::cos(angle);
    return plus(plus(scaled(a, c), scaled(cross(axis, a), std::sin(angle))), scaled(axis, dot(axis, a) * (1 - c)));
}

} // namespace elvis::view
